/* The library in a long-running C program: svnet_calls_bench MODEL CALLS [SIDE]
 * Prints the time of svnet_model_load (best of 5), then lets 4 threads embed an image of SIDE x SIDE pixels (default 96,
 * BGRA with gaps between rows) and score 22 poses in contexts that share the model, CALLS times in all. Prints the
 * resident memory of the process after a tenth of the calls and at the end. Exit status 1 if a result ever differs. */
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "svnet/svnet.h"

enum { kThreads = 4, kPoses = 22 };

static svnet_model* model;
static uint8_t* pixels;
static int side;
static size_t stride, feature_count;
static double poses[2 * kPoses];
static float* expected_features;
static float expected_scores[kPoses];
static long calls_per_thread;
static atomic_long differing, done;

static double now_ms(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static long resident_kb(void) {
  char line[128];
  long kb = 0;
  FILE* file = fopen("/proc/self/status", "r");
  while (file != NULL && fgets(line, sizeof line, file) != NULL)
    if (sscanf(line, "VmRSS: %ld", &kb) == 1) break;
  if (file != NULL) fclose(file);
  return kb;
}

static void* calls(void* unused) {
  svnet_context* context = NULL;
  float* features = malloc(feature_count * sizeof(float));
  float scores[kPoses];
  size_t best;
  (void)unused;
  if (features == NULL || svnet_context_create(model, &context) != SVNET_OK) {
    atomic_fetch_add(&differing, 1);
    free(features);
    return NULL;
  }
  for (long i = 0; i < calls_per_thread; ++i) {
    const int ok = svnet_context_embed(context, pixels, side, side, stride, SVNET_BGRA8, NULL, features) == SVNET_OK &&
                   svnet_context_score(context, features, poses, kPoses, scores) == SVNET_OK &&
                   svnet_context_best_view(context, features, poses, kPoses, &best, NULL) == SVNET_OK;
    if (!ok || memcmp(features, expected_features, feature_count * sizeof(float)) != 0 ||
        memcmp(scores, expected_scores, sizeof scores) != 0)
      atomic_fetch_add(&differing, 1);
    if (atomic_fetch_add(&done, 1) == kThreads * calls_per_thread / 10)
      printf("resident after a tenth of the calls: %ld kB\n", resident_kb());
  }
  svnet_context_free(context);
  free(features);
  return NULL;
}

int main(int argc, char** argv) {
  double least_ms = 1e9;
  pthread_t threads[kThreads];
  if (argc < 3) {
    fprintf(stderr, "usage: svnet_calls_bench MODEL CALLS [SIDE]\n");
    return 2;
  }
  for (int i = 0; i < 5; ++i) {
    const double begin = now_ms();
    svnet_model_free(model);
    if (svnet_model_load(argv[1], &model) != SVNET_OK) {
      fprintf(stderr, "%s\n", svnet_last_error());
      return 1;
    }
    if (now_ms() - begin < least_ms) least_ms = now_ms() - begin;
  }
  printf("load: %.1f ms\n", least_ms);
  calls_per_thread = atol(argv[2]) / kThreads;
  side = argc > 3 ? atoi(argv[3]) : 96;
  stride = (size_t)side * 4 + 12;
  feature_count = svnet_feature_count(model);
  pixels = malloc(stride * (size_t)side);
  expected_features = malloc(feature_count * sizeof(float));
  if (pixels == NULL || expected_features == NULL) return 1;
  for (size_t i = 0; i < stride * (size_t)side; ++i) pixels[i] = (uint8_t)(i * i / 97);
  for (int i = 0; i < kPoses; ++i) poses[2 * i] = 16.0 * i, poses[2 * i + 1] = 4.0 * i;
  if (svnet_embed(model, pixels, side, side, stride, SVNET_BGRA8, expected_features) != SVNET_OK ||
      svnet_score(model, expected_features, poses, kPoses, expected_scores) != SVNET_OK) {
    fprintf(stderr, "%s\n", svnet_last_error());
    return 1;
  }
  const double begin = now_ms();
  for (int i = 0; i < kThreads; ++i) pthread_create(&threads[i], NULL, calls, NULL);
  for (int i = 0; i < kThreads; ++i) pthread_join(threads[i], NULL);
  printf("resident at the end: %ld kB\n", resident_kb());
  printf("%ld calls in %.1f s, %ld results differ\n", kThreads * calls_per_thread, (now_ms() - begin) / 1e3,
         atomic_load(&differing));
  free(pixels);
  free(expected_features);
  svnet_model_free(model);
  return atomic_load(&differing) == 0 ? 0 : 1;
}
