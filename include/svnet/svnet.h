/* The C interface of svnet: which camera poses show the most of an object, predicted from its top image.
 *
 *   svnet_model* model;
 *   if (svnet_model_load("model.safetensors", &model) != SVNET_OK) { puts(svnet_last_error()); return 1; }
 *   float* features = malloc(svnet_feature_count(model) * sizeof(float));
 *   svnet_embed(model, pixels, height, width, 3 * width, SVNET_RGB8, features);   once per image
 *   svnet_score(model, features, poses, count, scores);                           as often as there are candidates
 *   svnet_model_free(model);
 *
 * Units: poses are pairs (theta, phi) in degrees, one after the other: the camera sits on the upper half-sphere around
 * the object, theta is its azimuth, in [-360, 720] (a whole turn changes nothing), phi its elevation above the table,
 * in [0, 90]; (90, 90) is the top view. A score is in [0, 1]; higher is more informative.
 *
 * Errors: functions that can fail return a status. Where it is not SVNET_OK, nothing is written to the outputs, unless
 * said otherwise, and svnet_last_error() has one line of text. No C++ exception leaves the library, which writes
 * nothing to stdout or stderr.
 *
 * Ownership: the caller owns all buffers that it passes, which are neither kept nor freed. A model belongs to the
 * caller until svnet_model_free.
 *
 * Threads: every function may be called from several threads at once, with the same model too. Only svnet_model_free
 * must come after all other uses of its model. A call uses the threads of the library's own pool where that is free,
 * else the calling thread alone; results do not depend on it.
 *
 * The environment: SVNET_THREADS sets the number of threads to begin with, SVNET_MAX_ISA caps the instruction set.
 * svnet_model_load reads SVNET_PRECISION, "f32" or "bf16" (faster and less exact, for processors with AVX512-BF16), and
 * SVNET_CONVOLUTION, "direct" or "winograd" (the default is whichever is faster). svnet_model_load reports a wrong
 * value, of SVNET_THREADS the first call that computes, as SVNET_INVALID_ARGUMENT.
 */
#ifndef SVNET_SVNET_H
#define SVNET_SVNET_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define SVNET_API __attribute__((visibility("default")))
#else
#define SVNET_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef enum svnet_status {
  SVNET_OK = 0,
  SVNET_INVALID_ARGUMENT = 1, /* a null pointer, a size, a format, an angle or a number out of range */
  SVNET_INVALID_MODEL = 2,    /* the model file cannot be read or is none */
  SVNET_OUT_OF_MEMORY = 3,
  SVNET_INTERNAL_ERROR = 4 /* anything else */
} svnet_status;

/* One byte per channel, in the order in memory. Alpha is ignored; grey is repeated. */
typedef enum svnet_pixel_format {
  SVNET_RGB8 = 0,
  SVNET_BGR8 = 1,
  SVNET_RGBA8 = 2,
  SVNET_BGRA8 = 3,
  SVNET_GRAY8 = 4
} svnet_pixel_format;

typedef struct svnet_model svnet_model;

/* The version of the library, such as "0.1.0". */
SVNET_API const char* svnet_version(void);

/* What the last function that failed in this thread had to say, in one line; "" where none has failed yet. Valid until
 * the next failure in this thread. */
SVNET_API const char* svnet_last_error(void);

/* The number of threads that the library computes with, in [1, 1024]. Waits for a computation in progress. */
SVNET_API svnet_status svnet_set_threads(int threads);

/* Reads a model file that svnet-train wrote (model.safetensors); `path` as the system takes it. On failure *model is
 * NULL. */
SVNET_API svnet_status svnet_model_load(const char* path, svnet_model** model);

/* Frees a model; NULL is allowed. */
SVNET_API void svnet_model_free(svnet_model* model);

/* The number D of features of an image; 0 for NULL. */
SVNET_API size_t svnet_feature_count(const svnet_model* model);

/* Features of a top image of any size up to 64 megapixels. `pixels`: `height` rows from the top, each `stride_bytes`
 * after the one before (at least width times the bytes of a pixel; after the last row nothing is read). `features`
 * receives svnet_feature_count(model) floats. */
SVNET_API svnet_status svnet_embed(const svnet_model* model, const uint8_t* pixels, int32_t height, int32_t width,
                                   size_t stride_bytes, svnet_pixel_format format, float* features);

/* The scores of `count` poses. `features`: svnet_feature_count(model) finite floats, from svnet_embed with the same
 * model. `poses_deg`: 2 * count numbers, theta and phi of each pose. `scores` receives count floats. With count 0
 * nothing is read or written, and poses_deg and scores may be NULL. */
SVNET_API svnet_status svnet_score(const svnet_model* model, const float* features, const double* poses_deg,
                                   size_t count, float* scores);

/* The number, from 0, of the pose with the highest score, the first among equals. `count` must be at least 1. `score`
 * receives that score; it may be NULL. */
SVNET_API svnet_status svnet_best_view(const svnet_model* model, const float* features, const double* poses_deg,
                                       size_t count, size_t* best, float* score);

#ifdef __cplusplus
}
#endif

#endif /* SVNET_SVNET_H */
