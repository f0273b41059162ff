/* best_pose MODEL TOP.png: prints the camera pose with the highest score, of 25 around the object.
 *
 *   cc -std=c99 best_pose.c -o best_pose $(pkg-config --cflags --libs svnet libpng)
 */
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <svnet/svnet.h>

static int failed(const char* file, const char* why) {
  fprintf(stderr, "best_pose: %s: %s\n", file, why);
  return 1;
}

int main(int argc, char** argv) {
  if (argc != 3) return fprintf(stderr, "usage: best_pose MODEL TOP.png\n"), 2;
  svnet_model* model;
  if (svnet_model_load(argv[1], &model) != SVNET_OK) return failed(argv[1], svnet_last_error());
  if (svnet_uses_depth(model)) return failed(argv[1], "the model needs depth too: call svnet_embed_with_depth");

  png_image image = {.version = PNG_IMAGE_VERSION};
  if (!png_image_begin_read_from_file(&image, argv[2])) return failed(argv[2], image.message);
  image.format = PNG_FORMAT_RGB;
  uint8_t* pixels = malloc(PNG_IMAGE_SIZE(image));
  float* features = malloc(svnet_feature_count(model) * sizeof(float));
  if (pixels == NULL || features == NULL) return failed(argv[2], "out of memory");
  if (!png_image_finish_read(&image, NULL, pixels, 0, NULL)) return failed(argv[2], image.message);

  double poses_deg[2 * 25] = {90, 90}; /* theta and phi of the top view, then three rings */
  size_t count = 1, best;
  for (int phi = 45; phi <= 75; phi += 15)
    for (int theta = 0; theta < 360; theta += 45, ++count) poses_deg[2 * count] = theta, poses_deg[2 * count + 1] = phi;

  float score;
  if (svnet_embed(model, pixels, (int32_t)image.height, (int32_t)image.width, 3 * (size_t)image.width, SVNET_RGB8,
                  features) != SVNET_OK ||
      svnet_best_view(model, features, poses_deg, count, &best, &score) != SVNET_OK)
    return failed(argv[2], svnet_last_error());
  printf("theta %g phi %g score %.4f\n", poses_deg[2 * best], poses_deg[2 * best + 1], score);

  free(features);
  free(pixels);
  svnet_model_free(model);
  return 0;
}
