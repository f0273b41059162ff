/* c_interface_probe MODEL MISTAKE: calls the C interface with a mistake, for bad_input_test.cpp: prints the error, exit 1. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <svnet/svnet.h>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const char* mistake = argv[2];
  const uint8_t pixels[4 * 4 * 3] = {0};
  const double poses[4] = {0, 45, 90, strcmp(mistake, "nan") == 0 ? NAN : 60};
  float scores[2];
  svnet_model* model;
  svnet_status status = svnet_model_load(argv[1], &model);
  float* features = malloc(svnet_feature_count(model) * sizeof(float) + 1);
  if (features == NULL) return 2;
  if (status == SVNET_OK)
    status = svnet_embed(model, pixels, 4, 4, strcmp(mistake, "stride") == 0 ? 8 : 12,
                         strcmp(mistake, "format") == 0 ? (svnet_pixel_format)5 : SVNET_RGB8, features);
  if (status == SVNET_OK) status = svnet_score(model, features, poses, 2, scores);
  if (status != SVNET_OK) fprintf(stderr, "c_interface_probe: %s\n", svnet_last_error());
  free(features);
  svnet_model_free(model);
  return status != SVNET_OK;
}
