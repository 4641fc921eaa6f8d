/* heatpath: geodesic distances and paths on images and volumes by letting heat flow through them.
 *
 * C99 and C++; link with libheatpath. Generated from crates/heatpath-capi, do not edit.
 *
 * Every function that can fail returns an hp_status, and hp_last_error_message() says what was
 * wrong. All memory stays the caller's, except for hp_paths and
 * hp_solver. Nothing is printed, and no state of
 * the process is changed; threads are started anew for a call and end before it returns.
 * All functions may be called from any thread.
 *
 * Structs begin with their size. Fill them with the _init function, or set struct_size where there
 * is none: a program then works with later versions of the library, whose structs may be longer.
 */

#ifndef HEATPATH_H
#define HEATPATH_H

#include <stdint.h>

/* The version of heatpath that this header belongs to. */
#define HP_VERSION_MAJOR 0
#define HP_VERSION_MINOR 1
#define HP_VERSION_PATCH 0
#define HP_VERSION_STRING "0.1.0"

/**
 * The version of the binary interface that this header describes.
 *
 * It is the number in the name of the shared library, libheatpath.so.0. It stays 0 as long as the
 * version of heatpath begins with 0, because until then each minor version may change anything:
 * compare hp_version_string() as well. From heatpath 1.0 on it changes when, and only when,
 * programs must be recompiled.
 */
#define HP_ABI_VERSION 0

/** Done. */
#define HP_OK 0

/** A pointer is NULL or misaligned, the size of a struct is wrong, or an option makes no sense. */
#define HP_INVALID_ARGUMENT 1

/** The description of a buffer is wrong: its type, sizes, strides or spacing. */
#define HP_INVALID_BUFFER 2

/** A pixel is infinite or not a number, or a given medium is not positive somewhere. */
#define HP_INVALID_IMAGE 3

/** A source or an end is missing, outside the image, inside a wall, or not a number. */
#define HP_INVALID_POINT 4

/** The time step is larger than the medium allows; the message says how large it may be. */
#define HP_UNSTABLE_STEP 5

/** The progress callback asked to stop. */
#define HP_CANCELLED 6

/**
 * There is not enough memory for a problem of this size, or HP_SOLVER_IMPLICIT needs more than
 * hp_options.memory allows; the message says how much.
 */
#define HP_OUT_OF_MEMORY 7

/** The operating system refused to start the threads. */
#define HP_NO_THREADS 8

/** This version of the library cannot do that. */
#define HP_UNSUPPORTED 9

/** A mistake inside heatpath. The library stays usable; please report it with the message. */
#define HP_PANIC 10

/** The medium is slower in places than the range of numbers allows. */
#define HP_RANGE 11

/** Pixels are uint8_t. */
#define HP_U8 1

/** Pixels are int8_t. */
#define HP_I8 2

/** Pixels are uint16_t. */
#define HP_U16 3

/** Pixels are int16_t. */
#define HP_I16 4

/** Pixels are uint32_t. */
#define HP_U32 5

/** Pixels are int32_t. */
#define HP_I32 6

/** Pixels are float. */
#define HP_F32 7

/** Pixels are double. */
#define HP_F64 8

/**
 * The same everywhere: distances are Euclidean, around the walls of the mask. Of the image only
 * the size and spacing count; its data may be NULL.
 */
#define HP_MEDIUM_UNIFORM 1

/**
 * Heat flows where the grey value f resembles that of the sources: k = |1 - |f0 - f||^power +
 * floor. The default.
 */
#define HP_MEDIUM_CONDUCTIVITY 2

/** Heat stays inside regions without edges (Perona and Malik). */
#define HP_MEDIUM_PERONA_MALIK 3

/** Grey value and edges together: the product of the two above. */
#define HP_MEDIUM_COMBINED 4

/** Heat runs along edges and thin lines: D = |grad f|^2 + floor. */
#define HP_MEDIUM_EDGES 5

/**
 * The image itself is the medium, positive everywhere and not scaled. Lengths are
 * ds / sqrt(image): a cost c per length is the image 1 / c^2.
 */
#define HP_MEDIUM_GIVEN 6

/**
 * The medium is hp_options.tensor, one symmetric positive definite matrix for each pixel: the
 * diffusion tensor D. Heat is fast along its eigenvectors of large eigenvalues, and lengths are
 * sqrt(dx' D^-1 dx); a metric tensor must be inverted. Of the image only the size and spacing
 * count; its data may be NULL.
 */
#define HP_MEDIUM_GIVEN_TENSOR 7

/** D = exp(-(|grad f| / contrast)^2). The default. */
#define HP_EDGE_STOP_EXPONENTIAL 1

/** D = 1 / (1 + (|grad f| / contrast)^2). */
#define HP_EDGE_STOP_RATIONAL 2

/**
 * The medium's own choice: divergence, but pointwise for HP_MEDIUM_CONDUCTIVITY and
 * HP_MEDIUM_GIVEN.
 */
#define HP_FORM_DEFAULT 0

/** u_t = div(D grad u). */
#define HP_FORM_DIVERGENCE 1

/** u_t = D laplace(u). */
#define HP_FORM_POINTWISE 2

/**
 * sqrt(-4 t log(u / u0)), where u0 is the temperature at the sources, and the like for implicit
 * heat. The default, for lengths. With several sources explicit heat flows twice, to make them
 * equally warm.
 */
#define HP_NORMALIZED 1

/**
 * sqrt(-4 t log u), Varadhan's formula as it stands, and -sqrt(t) log u of implicit heat: too long
 * near the sources.
 */
#define HP_VARADHAN 2

/**
 * The exact weighted distance, without heat: the eikonal equation by fast marching, to second order.
 * What is about heat alone is ignored: iterations, time, step, solver and memory. It takes one
 * thread.
 */
#define HP_EIKONAL 3

/** Many small time steps, for images of any size. The default. */
#define HP_SOLVER_EXPLICIT 0

/**
 * One time step of any length, or a few, by a sparse factorisation: prepared once, it serves many
 * sources. It takes some 550 bytes for each pixel of a picture, and many more for a volume.
 */
#define HP_SOLVER_IMPLICIT 1

/** The path ends at a source. */
#define HP_ENDED_SOURCE 1

/** There is no path: walls separate the end point from every source. */
#define HP_ENDED_UNREACHABLE 2

/**
 * There is no path: no heat has arrived at the end point, and more iterations would bring it there;
 * or it lies beyond hp_options.farthest.
 */
#define HP_ENDED_NOT_REACHED 3

/** The path was given up on the way, after more steps than the image should need. */
#define HP_ENDED_STEP_LIMIT 4

/**
 * Paths, one for each end point, in the order of the end points.
 *
 * Made by hp_paths_create() and freed by hp_paths_free(). It does not change, so any number of
 * threads may use it at once, and any thread may free it once the others are done.
 */
typedef struct hp_paths hp_paths;

/**
 * A medium prepared for distances from any sources.
 *
 * Made by hp_solver_create() and freed by hp_solver_free(). It does not change, so any number of
 * threads may use it at once, and any thread may free it once the others are done.
 */
typedef struct hp_solver hp_solver;

/**
 * What a function returns: HP_OK or the reason why it failed. The numbers never change their
 * meaning; later versions may add some.
 */
typedef int32_t hp_status;

/**
 * The caller's pixels, described but never owned or kept: one number per pixel.
 *
 * Fill it with hp_buffer_init(), then set data, type, size, and where needed the rest. The pixel
 * at column x, row y and slice z is found at data + x * byte_stride[0] + y * byte_stride[1] + z *
 * byte_stride[2]. With that rule a buffer can be a part of a larger picture or volume, one channel
 * of a coloured one, or upside down. Pixels need not be aligned, but must not overlap.
 *
 * Any number of threads may read the same buffer at once. Functions that take an input only
 * read it, although data is not const.
 */
typedef struct hp_buffer {
  /** sizeof(hp_buffer). */
  uint32_t struct_size;
  /**
   * HP_U8, HP_I8, HP_U16, HP_I16, HP_U32, HP_I32, HP_F32 or HP_F64, in the byte order of the
   * machine. There is no default.
   */
  uint32_t type;
  /**
   * The number of axes: 2, the default, for a picture; 3 for a volume. With 2 the third entry of
   * the arrays below is ignored.
   */
  uint32_t dimension;
  /** 0. */
  uint32_t reserved;
  /** The first pixel: column 0, row 0, slice 0. */
  void *data;
  /** The pixels along each axis: columns, rows, slices. */
  uint64_t size[3];
  /**
   * The bytes from a pixel to the next one along each axis; negative if that one lies before it
   * in memory. 0, the default, means that pixels, rows or slices follow each other without gaps.
   */
  int64_t byte_stride[3];
  /**
   * The physical distance of neighbouring pixels along each axis, positive; 1 by default.
   * Only that of the image counts.
   */
  double spacing[3];
} hp_buffer;

/**
 * Is called from time to time with the finished part, from 0 to 1 and never falling, always on
 * the thread that called the library. Anything but 0 cancels: the call then returns
 * HP_CANCELLED.
 *
 * It may call the library, but must not throw an exception or jump out.
 */
typedef int (*hp_progress)(double finished, void *user);

/**
 * What to compute and how. NULL in place of it means all defaults.
 *
 * Fill it with hp_options_init(), then change fields. It is only read, and not kept; several
 * threads may use the same one if its callback allows that. Parameters that the medium or the
 * estimator does not use are ignored.
 */
typedef struct hp_options {
  /** sizeof(hp_options). */
  uint32_t struct_size;
  /** One of HP_MEDIUM_...; HP_MEDIUM_CONDUCTIVITY by default. */
  uint32_t medium;
  /**
   * For conductivity and combined: how strongly unlike grey values are held back. Positive;
   * 3 by default.
   */
  double power;
  /**
   * For conductivity, combined and edges: what keeps the medium above zero. Positive; 0.001 by
   * default.
   */
  double floor;
  /**
   * For Perona-Malik and combined: the gradient, in grey values (full range 1) per pixel, at
   * which heat is held back. Positive; 0.03 by default.
   */
  double contrast;
  /**
   * For Perona-Malik and combined: HP_EDGE_STOP_EXPONENTIAL, the default, or
   * HP_EDGE_STOP_RATIONAL.
   */
  uint32_t edge_stop;
  /** For all media but uniform, conductivity and given tensor: one of HP_FORM_... */
  uint32_t form;
  /**
   * For Perona-Malik, combined and edges: the standard deviation, in pixels, of the Gaussian
   * before the gradient. 0, the default, is none.
   */
  double smoothing;
  /**
   * The pixel value that becomes grey value 0. Not a number (NAN), the default, stands for 0 if
   * pixels are HP_U8 or HP_U16, and else for the smallest value of the image.
   */
  double range_low;
  /**
   * The pixel value that becomes grey value 1. Not a number (NAN), the default, stands for the
   * largest value of the type if pixels are HP_U8 or HP_U16, and else for that of the image.
   */
  double range_high;
  /**
   * The number of time steps; heat moves one pixel a step. 0, the default, takes twice the
   * longest side of a picture and three times that of a volume, unless a time is given. Of
   * HP_SOLVER_IMPLICIT it is 1 by default, at most 1000, and may be given besides a time.
   */
  uint64_t iterations;
  /**
   * The time for which heat flows, in units of the smallest spacing squared; steps are shortened
   * to fit. 0, the default, leaves it to the iterations; of HP_SOLVER_IMPLICIT it stands for 16.
   */
  double time;
  /**
   * The time step, in units of the smallest spacing squared. Not a number (NAN), the default,
   * stands for 0.2 in pictures and 2/15 in volumes; 0 takes a safe fraction of the largest one
   * that the medium allows. HP_SOLVER_IMPLICIT has none: leave it NAN.
   */
  double step;
  /** HP_NORMALIZED, the default, HP_VARADHAN or HP_EIKONAL. */
  uint32_t estimator;
  /**
   * The number of threads, up to 1024; 0, the default, is one per processor, and 1 the calling
   * thread alone. Results do not depend on it.
   */
  uint32_t threads;
  /** Is told how far the computation is, and may cancel it. NULL by default. */
  hp_progress progress;
  /** What the progress callback gets as its second argument. */
  void *user;
  /** HP_SOLVER_EXPLICIT, the default, or HP_SOLVER_IMPLICIT. */
  uint32_t solver;
  /** 0. */
  uint32_t reserved;
  /**
   * For conductivity and combined: the grey value f0, from 0 to 1, that the image is compared
   * with. Not a number (NAN), the default, stands for that of the sources.
   */
  double reference;
  /**
   * For HP_SOLVER_IMPLICIT: the most bytes that the factorisation may take. 0, the default,
   * stands for 4 GiB.
   */
  uint64_t memory;
  /**
   * For HP_EIKONAL: the distance, in physical units, beyond which nothing is reached. 0, the
   * default, stands for no end.
   */
  double farthest;
  /**
   * For HP_MEDIUM_GIVEN_TENSOR: the components of the matrices in physical units, those of the
   * first pixel first, then x fastest: xx, xy, yy of each pixel of a picture and xx, xy, xz, yy,
   * yz, zz of a volume. They follow each other without gaps, and need not be aligned.
   */
  const double *tensor;
  /** The number of these components: 3 or, in a volume, 6 for each pixel. */
  uint64_t tensor_count;
} hp_options;

/** What is known about a path besides its points. Set struct_size, then call hp_paths_info(). */
typedef struct hp_path_info {
  /** sizeof(hp_path_info). */
  uint32_t struct_size;
  /** One of HP_ENDED_... */
  uint32_t ending;
  /** Which of the sources the path ends at, counted from 0; -1 if at none. */
  int64_t source;
  /** The number of points, at least 1. */
  uint64_t point_count;
  /** The length in pixels. */
  double length;
  /** The length in physical units. */
  double physical_length;
  /** The distance of the end point from the sources, infinite if the path reaches none. */
  double distance;
} hp_path_info;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * The HP_ABI_VERSION of the library that is loaded. A program that loads the library at run time
 * compares it with the one of its header before any other call.
 */
uint32_t hp_abi_version(void);

/** The version of the library that is loaded, such as "0.1.0". The text is never freed. */
const char *hp_version_string(void);

/**
 * The message of the last call that failed on this thread: one line, in English, UTF-8. An empty
 * text if none has failed yet; calls that succeed leave it as it is.
 *
 * The text belongs to the library and stays valid until the next call that fails on the same
 * thread, or until the thread ends.
 */
const char *hp_last_error_message(void);

/**
 * The name of a status, such as "HP_INVALID_POINT"; "unknown status" for any other number. The
 * text is never freed.
 */
const char *hp_status_name(hp_status status);

/**
 * Fills *buffer with the defaults; struct_size is sizeof(hp_buffer).
 *
 * The caller promises:
 * buffer is NULL or points to struct_size writable bytes.
 */
hp_status hp_buffer_init(struct hp_buffer *buffer, uint32_t struct_size);

/**
 * Fills *options with the defaults; struct_size is sizeof(hp_options).
 *
 * The caller promises:
 * options is NULL or points to struct_size writable bytes.
 */
hp_status hp_options_init(struct hp_options *options, uint32_t struct_size);

/**
 * Computes the distance of every pixel from the nearest source, by letting heat flow or, with
 * HP_EIKONAL, exactly.
 *
 * image: the picture or volume that makes the medium, see hp_options; any type of pixel. Its
 * dimension, 2 or 3, is that of all other arguments.
 *
 * mask: pixels that are 0 are walls, all others are open; of the same size. NULL for no walls.
 *
 * sources: source_count points of as many coordinates as the image has dimensions, x, y or
 * x, y, z, in pixels: 0, 0, 0 is the centre of the first one, x runs along the row, y from row to
 * row, z from slice to slice; fractions are allowed.
 *
 * options: NULL for the defaults.
 *
 * distance: receives the result; of the same size, HP_F32 or HP_F64, with any strides; it may be
 * the memory of the image. Distances are in physical units (those of the image's spacing) where
 * the medium is 1, and infinite in walls, wherever no heat has arrived and beyond
 * hp_options.farthest. It is written only if HP_OK is returned.
 *
 * The caller promises:
 * The structs are as large as their struct_size says, and buffers and points are as large as
 * their description. The result is not used by another thread meanwhile.
 */
hp_status hp_distance(const struct hp_buffer *image,
                      const struct hp_buffer *mask,
                      const double *sources,
                      uint64_t source_count,
                      const struct hp_options *options,
                      const struct hp_buffer *distance);

/**
 * Traces the minimal path from each end point to a source.
 *
 * image, mask, sources, source_count and options are those of hp_distance().
 *
 * ends: end_count points like the sources.
 *
 * paths: receives the paths, to be freed with hp_paths_free(), or NULL if anything but HP_OK is
 * returned.
 *
 * An end point from which no source can be reached is not an error: hp_path_info tells.
 *
 * The caller promises:
 * The structs are as large as their struct_size says, and buffers and points are as large as
 * their description.
 */
hp_status hp_paths_create(const struct hp_buffer *image,
                          const struct hp_buffer *mask,
                          const double *sources,
                          uint64_t source_count,
                          const double *ends,
                          uint64_t end_count,
                          const struct hp_options *options,
                          struct hp_paths **paths);

/**
 * Frees paths; NULL is fine.
 *
 * The caller promises:
 * paths is NULL or comes from hp_paths_create() and was not freed yet.
 */
void hp_paths_free(struct hp_paths *paths);

/**
 * Writes the number of paths to *count.
 *
 * The caller promises:
 * paths is NULL or comes from hp_paths_create(); count is NULL or points to a uint64_t.
 */
hp_status hp_paths_count(const struct hp_paths *paths, uint64_t *count);

/**
 * Writes what is known about a path to *info, whose struct_size must be set.
 *
 * The caller promises:
 * paths is NULL or comes from hp_paths_create(); info is NULL or points to as many bytes as
 * its struct_size says.
 */
hp_status hp_paths_info(const struct hp_paths *paths, uint64_t index, struct hp_path_info *info);

/**
 * Copies the points of a path, in pixel coordinates, from the end point to the source.
 *
 * coordinates: receives x, y of each point or, if the image was a volume, x, y, z: two or three
 * times as many doubles as hp_path_info.point_count says.
 *
 * capacity: how many points there is room for. If it is too small nothing is written.
 *
 * The caller promises:
 * paths is NULL or comes from hp_paths_create(); coordinates is NULL or has room for
 * capacity points of two or, if the image was a volume, three doubles.
 */
hp_status hp_paths_points(const struct hp_paths *paths,
                          uint64_t index,
                          double *coordinates,
                          uint64_t capacity);

/**
 * Prepares distances from sources that are not known yet; with HP_SOLVER_IMPLICIT, analyses and
 * factors the system.
 *
 * image and mask are those of hp_distance(). They are not needed any more when this returns.
 *
 * options: those of hp_distance(), but HP_MEDIUM_CONDUCTIVITY, the default, and
 * HP_MEDIUM_COMBINED need a reference, so NULL will not do. Of the estimator it counts whether it
 * is HP_EIKONAL: such a solver gives those distances only, and other solvers never do.
 *
 * solver: receives the solver, to be freed with hp_solver_free(), or NULL if anything but HP_OK is
 * returned. HP_OUT_OF_MEMORY means that the image is too large for HP_SOLVER_IMPLICIT; the
 * message names the memory that it needs.
 *
 * The caller promises:
 * The structs are as large as their struct_size says, and buffers are as large as their
 * description.
 */
hp_status hp_solver_create(const struct hp_buffer *image,
                           const struct hp_buffer *mask,
                           const struct hp_options *options,
                           struct hp_solver **solver);

/**
 * Computes the distance of every pixel from each of several sources: one map for each of them.
 *
 * sources: source_count points, as for hp_distance().
 *
 * options: only estimator, threads, progress and user count here, and of a solver made with
 * HP_EIKONAL the estimator does not; the rest was fixed when the solver was made. NULL for the
 * defaults. With HP_SOLVER_IMPLICIT sources are shared between the threads; the results do not
 * depend on how many there are.
 *
 * distances: describes the first map, as for hp_distance().
 *
 * map_stride: the bytes from the first pixel of a map to that of the next one; negative if that
 * lies before it. 0 means that maps follow each other without gaps. Maps must not lie in one
 * another.
 *
 * If the call is cancelled some of the maps may have been written; after any other failure none
 * was.
 *
 * The caller promises:
 * solver is NULL or comes from hp_solver_create() and was not freed yet. The structs are as
 * large as their struct_size says, and the maps and points are as large as their description.
 * The results are not used by another thread meanwhile.
 */
hp_status hp_solver_distances(const struct hp_solver *solver,
                              const double *sources,
                              uint64_t source_count,
                              const struct hp_options *options,
                              const struct hp_buffer *distances,
                              int64_t map_stride);

/**
 * Frees a solver; NULL is fine.
 *
 * The caller promises:
 * solver is NULL or comes from hp_solver_create() and was not freed yet.
 */
void hp_solver_free(struct hp_solver *solver);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* HEATPATH_H */
