/* score_c MODEL IMAGE.ppm THETA PHI [THETA PHI]...: prints one score per line, then the index of the best. */
#include <stdio.h>
#include <stdlib.h>
#include <svnet/svnet.h>

static int failed(const char* what) {
  fprintf(stderr, "%s: %s\n", what, svnet_last_error());
  return 1;
}

int main(int argc, char** argv) {
  if (argc < 5 || argc % 2 == 0) return 2;
  svnet_model* model;
  if (svnet_model_load(argv[1], &model) != SVNET_OK) return failed("load");

  FILE* file = fopen(argv[2], "rb");
  int width, height;
  if (file == NULL || fscanf(file, "P6 %d %d 255", &width, &height) != 2 || fgetc(file) != '\n') return 1;
  uint8_t* pixels = malloc((size_t)width * (size_t)height * 3);
  if (pixels == NULL || fread(pixels, 3, (size_t)width * (size_t)height, file) != (size_t)width * (size_t)height)
    return 1;
  fclose(file);

  const size_t count = (size_t)(argc - 3) / 2;
  double* poses_deg = malloc(2 * count * sizeof(double));
  float* features = malloc(svnet_feature_count(model) * sizeof(float));
  float* scores = malloc(count * sizeof(float));
  if (poses_deg == NULL || features == NULL || scores == NULL) return 1;
  for (size_t i = 0; i < 2 * count; ++i) poses_deg[i] = atof(argv[3 + i]);

  size_t best;
  if (svnet_embed(model, pixels, height, width, (size_t)width * 3, SVNET_RGB8, features) != SVNET_OK)
    return failed("embed");
  if (svnet_score(model, features, poses_deg, count, scores) != SVNET_OK) return failed("score");
  if (svnet_best_view(model, features, poses_deg, count, &best, NULL) != SVNET_OK) return failed("best view");
  for (size_t i = 0; i < count; ++i) printf("%.9g\n", scores[i]);
  printf("%zu\n", best);

  free(scores);
  free(features);
  free(poses_deg);
  free(pixels);
  svnet_model_free(model);
  return 0;
}
