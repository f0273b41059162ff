/* The C interface of svnet: predicts from the top image of an object which camera poses show most of it.
 *
 *   svnet_model* model;
 *   if (svnet_model_load("model.safetensors", &model) != SVNET_OK) { puts(svnet_last_error()); return 1; }
 *   float* features = malloc(svnet_feature_count(model) * sizeof(float));
 *   svnet_embed(model, pixels, height, width, 3 * width, SVNET_RGB8, features);   once per image
 *   svnet_score(model, features, poses, count, scores);                           as often as there are candidates
 *   svnet_model_free(model);
 *
 * Units: a pose is a pair (theta, phi) in degrees; poses are stored one after the other. The camera is on the upper
 * half-sphere around the object. theta is its azimuth, in [-360, 720] (a full turn changes nothing); phi is its
 * elevation above the table, in [0, 90]. An angle out of range by at most 1e-4 degrees, by rounding, is taken for the
 * bound. (90, 90) is the top view. A score is in [0, 1]; higher is more informative.
 *
 * Errors: functions that can fail return a status. If it is not SVNET_OK, svnet_last_error() returns one line of text,
 * and the outputs are not written, unless a function says otherwise. The library throws no C++ exception and writes
 * nothing to stdout or stderr.
 *
 * Ownership: the caller owns all buffers that it passes; the library neither keeps nor frees them. The caller owns a
 * model and frees it with svnet_model_free.
 *
 * Threads: every function may be called from several threads at once, with the same model too, but with one context by
 * one thread at a time. Only svnet_model_free must be called after all other uses of its model, and
 * svnet_context_free after those of its context. A call uses the thread pool of the library if it is free, otherwise
 * only the calling thread. The results are the same.
 *
 * Environment: SVNET_THREADS sets the initial number of threads. SVNET_MAX_ISA limits the instruction set.
 * SVNET_PRECISION is "f32" or "bf16" (faster and less exact, for processors with AVX512-BF16); a model that was trained
 * in int8 runs so whatever it says, and "int8" makes any other SVNET_INVALID_MODEL. SVNET_CONVOLUTION is "direct" or "winograd" (default: the faster one).
 * svnet_model_load reads the last three and returns SVNET_INVALID_ARGUMENT for a wrong value; for SVNET_THREADS the
 * first call that computes does so.
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
  SVNET_INVALID_ARGUMENT = 1, /* null pointer; wrong size or format; angle or number out of range */
  SVNET_INVALID_MODEL = 2,    /* the file cannot be read or is not a model */
  SVNET_OUT_OF_MEMORY = 3,
  SVNET_INTERNAL_ERROR = 4 /* anything else */
} svnet_status;

/* One byte per channel, in memory order. Alpha is ignored; grey is copied to all three channels. */
typedef enum svnet_pixel_format {
  SVNET_RGB8 = 0,
  SVNET_BGR8 = 1,
  SVNET_RGBA8 = 2,
  SVNET_BGRA8 = 3,
  SVNET_GRAY8 = 4
} svnet_pixel_format;

typedef struct svnet_model svnet_model;

/* The memory of calls with one model: see svnet_context_create. */
typedef struct svnet_context svnet_context;

typedef enum svnet_log_level { SVNET_LOG_INFO = 0, SVNET_LOG_WARNING = 1 } svnet_log_level;

/* Receives one line of text without a line break, valid during the call. */
typedef void (*svnet_log_callback)(svnet_log_level level, const char* line, void* user_data);

/* The version of the library, such as "0.1.0". */
SVNET_API const char* svnet_version(void);

/* The error of the last function that failed in this thread, in one line; "" if none has failed. Valid until the next
 * failure in this thread. */
SVNET_API const char* svnet_last_error(void);

/* Sets the number of threads of the library, in [1, 1024]. Waits for computations in progress. */
SVNET_API svnet_status svnet_set_threads(int threads);

/* Sets what receives the log of the library; NULL (the default): nothing. Logged are the number of threads when it
 * changes; of a model that is loaded, the time, instruction set, frame and kernels; and, as a warning, each top image
 * in which the object's shape is unlike those that the model was trained on. The callback is called by the thread that
 * works, so possibly by several at once. It must return normally and not call the library, which may hold locks;
 * svnet_set_log fails there. svnet_set_log returns after the last call of the former callback. */
SVNET_API svnet_status svnet_set_log(svnet_log_callback callback, void* user_data);

/* Reads a model file that svnet-train wrote (model.safetensors). `path`: in the encoding of the file system. On failure
 * *model is NULL. */
SVNET_API svnet_status svnet_model_load(const char* path, svnet_model** model);

/* Frees a model; NULL is allowed. */
SVNET_API void svnet_model_free(svnet_model* model);

/* The number D of features of an image; 0 for NULL. */
SVNET_API size_t svnet_feature_count(const svnet_model* model);

/* Computes the features of a top image of any size up to 64 megapixels. `pixels`: `height` rows from the top;
 * `stride_bytes`: distance between the starts of two rows, at least width times the bytes of a pixel. Nothing is read
 * after the last pixel. `features` receives svnet_feature_count(model) floats. */
SVNET_API svnet_status svnet_embed(const svnet_model* model, const uint8_t* pixels, int32_t height, int32_t width,
                                   size_t stride_bytes, svnet_pixel_format format, float* features);

/* Whether the model was trained with the depth of top views: 1, or 0 if not or for NULL. Such a model needs
 * svnet_embed_with_depth; svnet_embed returns SVNET_INVALID_ARGUMENT. */
SVNET_API int svnet_uses_depth(const svnet_model* model);

/* svnet_embed with the depth of the top view: `depth_m` is height * width floats, rows from the top without gaps, in
 * metres along the camera's axis; 0, negative numbers and NaN mean not measured. A model that does not use depth
 * ignores it. */
SVNET_API svnet_status svnet_embed_with_depth(const svnet_model* model, const uint8_t* pixels, int32_t height,
                                              int32_t width, size_t stride_bytes, svnet_pixel_format format,
                                              const float* depth_m, float* features);

/* Computes the scores of `count` poses. `features`: svnet_feature_count(model) finite floats, from svnet_embed with the
 * same model. `poses_deg`: 2 * count doubles, theta and phi of each pose. `scores` receives count floats. With count 0
 * nothing is read or written, and poses_deg and scores may be NULL. */
SVNET_API svnet_status svnet_score(const svnet_model* model, const float* features, const double* poses_deg,
                                   size_t count, float* scores);

/* Finds the pose with the highest score, the first one in a tie. `best` receives its index; `score`, if not NULL, its
 * score. `count` must be at least 1. */
SVNET_API svnet_status svnet_best_view(const svnet_model* model, const float* features, const double* poses_deg,
                                       size_t count, size_t* best, float* score);

/* Finds up to k poses to take together, one after the other: the best first, then each time the one with the highest
 * score + s * min(a, 90) / 90, where a is the angle in degrees to the nearest pose that was found (between viewing
 * directions, along the great circle) and s the standard deviation of all scores; the first one in a tie. Two of them
 * are at least min_angle_deg degrees apart, in [0, 180]; up to 1e-4 degrees less count as enough. With the mean of
 * their features, objects are told apart better than with that of the k best poses. `indices` receives them in this
 * order, and `scores`, if not NULL, their scores; both have room for the smaller of k and count. `found` receives their
 * number, at least 1: less than k if no other pose differs enough. k and count must be at least 1. */
SVNET_API svnet_status svnet_best_views(const svnet_model* model, const float* features, const double* poses_deg,
                                        size_t count, size_t k, double min_angle_deg, size_t* indices, float* scores,
                                        size_t* found);

/* How much the best pose is better than looking from above: the highest score of `count` poses minus the score of
 * (90, 90), which need not be one of them; negative if the top view is better than all. `count` must be at least 1. */
SVNET_API svnet_status svnet_margin(const svnet_model* model, const float* features, const double* poses_deg,
                                    size_t count, float* margin);

/* What moving the camera from (90, 90) to the best pose is expected to gain, as semantic score (0 to 1), for objects of
 * categories that the model has not seen. */
typedef struct svnet_gain_estimate {
  double expected;
  double low, high;   /* four of five gains are between these */
  double probability; /* that the gain is above 0 */
} svnet_gain_estimate;

/* `gain` receives the estimate for the best of `count` poses; count must be at least 1. A model that does not know is
 * SVNET_INVALID_ARGUMENT: models of the frame camera, and of earlier versions. */
SVNET_API svnet_status svnet_gain(const svnet_model* model, const float* features, const double* poses_deg,
                                  size_t count, svnet_gain_estimate* gain);

/* The numbers that say what the picture of a view shows of the object's shape. */
#define SVNET_VIEW_SHAPE_SIZE 3

/* Measures the picture of a view, taken from any camera pose; arguments as for svnet_embed. `shape` receives
 * SVNET_VIEW_SHAPE_SIZE floats, all 0 if the picture does not show one whole object. No model is needed. */
SVNET_API svnet_status svnet_view_shape(const uint8_t* pixels, int32_t height, int32_t width, size_t stride_bytes,
                                        svnet_pixel_format format, float* shape);

/* Whether the model knows which view to take next (it was trained with sv_net.next_view): 1, or 0 if not or for NULL.
 */
SVNET_API int svnet_knows_next_view(const svnet_model* model);

/* Finds the pose to take next, when `taken` views of an object were taken (at least 1; the top view counts only if it
 * is among them). `features`: of its top image, from svnet_embed. `taken_deg`: 2 * taken doubles, the poses of these
 * views. `taken_shapes`: SVNET_VIEW_SHAPE_SIZE floats of each, from svnet_view_shape. Of the `count` candidates those
 * count that differ from each taken pose, by min_angle_deg or more ([0, 180]; up to 1e-4 degrees less count as enough).
 * `best` receives the index of the one with the highest score, the first one in a tie; `count` if none differs enough.
 * `scores`, if not NULL, receives the scores of all candidates: about 1/2 plus what the view and a taken view tell
 * together, more than the other candidates would. A model that does not know is SVNET_INVALID_ARGUMENT. */
SVNET_API svnet_status svnet_next_view(const svnet_model* model, const float* features, const double* taken_deg,
                                       const float* taken_shapes, size_t taken, const double* poses_deg, size_t count,
                                       double min_angle_deg, size_t* best, float* scores);

/* Writes the poses of a grid, sorted by elevation, then azimuth: theta_steps azimuths (1 to 3600), evenly from 0, at
 * each of phi_steps elevations (1 to 1000), evenly from lowest_phi_deg to highest_phi_deg, both included; with one step
 * the lowest alone. Expects 0 <= lowest <= highest <= 90. At 90 degrees there is one pose, (90, 90). `count` receives
 * the number of poses. `poses_deg` has room for `capacity` poses, 2 * capacity doubles; if it is NULL, they are counted
 * only. Too little room is SVNET_INVALID_ARGUMENT. */
SVNET_API svnet_status svnet_grid(int32_t theta_steps, int32_t phi_steps, double lowest_phi_deg, double highest_phi_deg,
                                  double* poses_deg, size_t capacity, size_t* count);

/* Puts `rows` items into groups of like items, by Ward's agglomerative clustering. `features`: rows * columns finite
 * floats, the features of one item after the other, such as those of svnet_embed or of any network; no model is needed.
 * For an item that was seen several times, pass the mean of its features. `groups`: the number of groups, up to rows;
 * 0: it is estimated, as 1 only if all items are equal. `labels` receives the group of each item, numbered from 0 in
 * order of first appearance; `count`, if not NULL, the number of groups. rows: 1 to 65535; needs 8 rows^2 bytes. */
SVNET_API svnet_status svnet_group(const float* features, size_t rows, size_t columns, size_t groups, int32_t* labels,
                                   size_t* count);

/* Makes a context: memory for calls with `model`, which must live longer. One thread at a time uses a context; several
 * contexts share a model. The functions below give the results of those above. They keep what they need: after a first
 * call with an image, and with poses, of a size, calls with images and as many poses of that size allocate no memory
 * (a larger size allocates once more; svnet_set_threads may too, and a call that fails). One exception: in models that
 * measure or turn the top image, that is of another frame than `camera`, svnet_context_embed allocates for the
 * silhouette and the turned images. What depends on the features alone is also kept, so further calls with the same
 * features are faster. On failure *context is NULL. */
SVNET_API svnet_status svnet_context_create(const svnet_model* model, svnet_context** context);

/* Frees a context; NULL is allowed. */
SVNET_API void svnet_context_free(svnet_context* context);

/* svnet_embed and, if depth_m is not NULL, svnet_embed_with_depth. */
SVNET_API svnet_status svnet_context_embed(svnet_context* context, const uint8_t* pixels, int32_t height, int32_t width,
                                           size_t stride_bytes, svnet_pixel_format format, const float* depth_m,
                                           float* features);

/* svnet_score, svnet_best_view, svnet_best_views, svnet_margin, svnet_gain and svnet_next_view. */
SVNET_API svnet_status svnet_context_score(svnet_context* context, const float* features, const double* poses_deg,
                                           size_t count, float* scores);
SVNET_API svnet_status svnet_context_best_view(svnet_context* context, const float* features, const double* poses_deg,
                                               size_t count, size_t* best, float* score);
SVNET_API svnet_status svnet_context_best_views(svnet_context* context, const float* features, const double* poses_deg,
                                                size_t count, size_t k, double min_angle_deg, size_t* indices,
                                                float* scores, size_t* found);
SVNET_API svnet_status svnet_context_margin(svnet_context* context, const float* features, const double* poses_deg,
                                            size_t count, float* margin);
SVNET_API svnet_status svnet_context_gain(svnet_context* context, const float* features, const double* poses_deg,
                                          size_t count, svnet_gain_estimate* gain);
SVNET_API svnet_status svnet_context_next_view(svnet_context* context, const float* features, const double* taken_deg,
                                               const float* taken_shapes, size_t taken, const double* poses_deg,
                                               size_t count, double min_angle_deg, size_t* best, float* scores);

#ifdef __cplusplus
}
#endif

#endif /* SVNET_SVNET_H */
