/* heatpath: geodesic distances and paths on images, volumes and triangle meshes by letting heat flow
 * through them.
 *
 * C99 and C++; link with libheatpath. Generated from crates/heatpath-capi, do not edit.
 *
 * Every function that can fail returns an hp_status, and hp_last_error_message() says what was
 * wrong. All memory stays the caller's, except for what the functions that end in _create hand out.
 * Nothing is printed, and no state of the process is changed; threads are started anew for a call and
 * end before it returns. All functions may be called from any thread.
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

/** The description of a buffer or list is wrong: its type, sizes, strides or spacing. */
#define HP_INVALID_BUFFER 2

/** A pixel or value is infinite or not a number, or a given medium is not positive somewhere. */
#define HP_INVALID_IMAGE 3

/** A source or an end is missing, outside the image, inside a wall, not on the mesh, or not a number. */
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

/**
 * Points and faces are no mesh: there is no face, a face uses a vertex that does not exist, or a
 * coordinate is infinite or not a number; or faces lie in each other, and HP_MESH_EXACT does not end.
 */
#define HP_INVALID_MESH 12

/** There is nothing to find: the image shows no structure, or no heat from one end reaches the other. */
#define HP_NO_ANSWER 13

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

/**
 * D of eq. (12): heat runs along the directions of the image, see hp_options.directions and
 * anisotropy.
 */
#define HP_MEDIUM_TENSOR 8

/**
 * k = v^power + floor, with the response v, from 0 to 1, of a filter for tubes: vessels, wires,
 * fibres; see hp_options.polarity, scales, elongation and anisotropy.
 */
#define HP_MEDIUM_VESSELNESS 9

/** Along the axis of least curvature of the grey values: along tubes. The default. */
#define HP_DIRECTIONS_HESSIAN 0

/** Along the lines of a texture. */
#define HP_DIRECTIONS_STRUCTURE 1

/** Along edges: across the gradient. */
#define HP_DIRECTIONS_GRADIENT 2

/** Bright tubes for HP_MEDIUM_VESSELNESS, both kinds for HP_MEDIUM_TENSOR. The default. */
#define HP_POLARITY_DEFAULT 0

/** Tubes that are brighter than what is around them. */
#define HP_POLARITY_BRIGHT 1

/** Tubes that are darker than what is around them. */
#define HP_POLARITY_DARK 2

/** Both kinds. */
#define HP_POLARITY_BOTH 3

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
 * The heat method: heat flows for a short time, and distances are the function that rises along its
 * direction. Prepared once, it is fast for many sources; distances are smooth. Not for media of
 * tensors. It takes some 1.1 kB for each pixel of a picture, and many more for a volume; of the
 * options of heat time (0, the default, stands for 1 over the mean of the medium) and memory count.
 */
#define HP_HEAT_METHOD 4

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

/** The most scales that hp_tube_scales() finds. */
#define HP_MOST_TUBE_SCALES 3

/** The path ends at a source. */
#define HP_ENDED_SOURCE 1

/** There is no path: walls separate the end point from every source. */
#define HP_ENDED_UNREACHABLE 2

/**
 * There is no path: no heat has arrived at the end point, and more iterations would bring it there;
 * or it lies beyond hp_options.farthest.
 */
#define HP_ENDED_NOT_REACHED 3

/**
 * The path was given up on the way: after more steps than the image should need, or where nothing
 * leads down the distances of a mesh.
 */
#define HP_ENDED_STEP_LIMIT 4

/** An isoline that ends at the border of a mesh, or where others meet it. */
#define HP_ENDED_OPEN 5

/** An isoline or loop whose last point is joined to the first. */
#define HP_ENDED_CLOSED 6

/** Heat begins again from all that has been found. The default. */
#define HP_VOTES_ACCUMULATED 0

/** One vote from the front of heat that has flowed for long. */
#define HP_VOTES_FRONT 1

/** Heat flows on from vote to vote. */
#define HP_VOTES_MULTIPLE 2

/** Fast marching, and the paths from 500 random pixels. */
#define HP_VOTES_RANDOM 3

/** Fast marching, and the paths from all pixels of the border. */
#define HP_VOTES_BORDER 4

/** Peaks of heat on circles. The default. */
#define HP_KEY_POINTS_HEAT 0

/** Points that paths of one length lead to, by fast marching. */
#define HP_KEY_POINTS_LENGTH 1

/** All was found that there was to find. */
#define HP_STOP_COMPLETE 0

/** Votes kept as large a part of the image as they may. */
#define HP_STOP_LARGEST_SHARE 1

/** Another round of votes found little that was new. */
#define HP_STOP_SETTLED 2

/** These were all rounds of votes. */
#define HP_STOP_ROUNDS 3

/** There were as many key points as there may be, 10,000. */
#define HP_STOP_MOST 4

/** Numbers are int64_t; in hp_array only. */
#define HP_I64 9

/** Numbers are uint64_t; in hp_array only. */
#define HP_U64 10

/** Distances are lengths on the surface. The default. */
#define HP_MESH_UNIFORM 1

/**
 * hp_mesh_options.values are the squared speed P at each vertex: lengths are ds / sqrt(P). The
 * slowness of a face is the mean of 1 / sqrt(P) at its corners.
 */
#define HP_MESH_SPEED_SQ 2

/** hp_mesh_options.values are the slowness F of each face: lengths are F ds. */
#define HP_MESH_SLOWNESS 3

/**
 * hp_mesh_options.values are the metric G of each face, a symmetric positive definite matrix xx, xy,
 * xz, yy, yz, zz: lengths are sqrt(dx' G dx).
 */
#define HP_MESH_METRIC 4

/**
 * hp_mesh_options.values are a texture or measurement f, from 0 to 1, at each vertex, and P = |1 -
 * |reference - f||^power + floor: ways are short where f resembles the reference.
 */
#define HP_MESH_SCALARS 5

/**
 * P = floor + (1 - floor) min(kappa / kappa_q, 1)^power with the curvature kappa and its quantile
 * kappa_q: ways are short where the surface bends, along ridges and valleys.
 */
#define HP_MESH_CURVATURE 6

/** As HP_MESH_CURVATURE along the direction of the ridge or valley, and 1 / sqrt(floor) across it. */
#define HP_MESH_CREASE 7

/** HP_MESH_EXACT for up to 20,000 faces that are all equally slow; else HP_MESH_EIKONAL. The default. */
#define HP_MESH_AUTO 0

/**
 * The heat method: heat flows for a short time, and distances are the function that rises along its
 * direction. Prepared once, it is then faster than the others for many sources. Distances are
 * smooth, and too short where the surface is coarse or narrow. Not for media whose slowness
 * jumps.
 */
#define HP_MESH_HEAT 1

/** Fast marching with round fronts: little to prepare, for any medium. */
#define HP_MESH_EIKONAL 2

/**
 * The exact distance on the triangles, by straight lines unfolded over the faces. For media that are
 * the same everywhere, and meshes of up to some 100,000 vertices.
 */
#define HP_MESH_EXACT 3

/**
 * Explicit heat in many small steps, as the paper has it: right where all edges are about equally
 * long, and to compare with. Sources must have no offsets.
 */
#define HP_MESH_EXPLICIT 4

/** Ridges and valleys count. The default. */
#define HP_BEND_BOTH 0

/** Ridges: where the surface is convex as seen from outside. */
#define HP_BEND_CONVEX 1

/** Valleys: where it is concave. */
#define HP_BEND_CONCAVE 2

/** Signed angles between faces, added up over a ball: for sharp edges and noisy meshes. The default. */
#define HP_CURVATURE_NORMAL_CYCLES 0

/** The changes of the normals, by least squares: the most accurate on smooth surfaces without noise. */
#define HP_CURVATURE_LEAST_SQUARES 1

/**
 * All functions of this header, for programs that load the library at run time: one call of dlsym()
 * for hp_get_api() is enough. Later versions add functions at the end.
 */
typedef struct hp_api hp_api;

/**
 * Curves as a graph: nodes, and branches between them.
 *
 * Made by hp_votes_create(), hp_key_points_create() or hp_skeleton_create(), and freed by
 * hp_graph_free(). It does not change, so any number of threads may use it at once, and any thread
 * may free it once the others are done.
 */
typedef struct hp_graph hp_graph;

/**
 * A triangle mesh: a copy of the caller's points and faces, cleaned.
 *
 * Made by hp_mesh_create() and freed by hp_mesh_free(), even while solvers that were made from it
 * live on. It does not change, so any number of threads may use it at once, and any thread may free
 * it once the others are done.
 */
typedef struct hp_mesh hp_mesh;

/**
 * A medium on a mesh, prepared for distances and paths from any sources.
 *
 * Made by hp_mesh_solver_create() and freed by hp_mesh_solver_free(). It does not change, so any
 * number of threads may use it at once, and any thread may free it once the others are done.
 */
typedef struct hp_mesh_solver hp_mesh_solver;

/**
 * Paths, one for each end point, in the order of the end points; or isolines and loops.
 *
 * Made by hp_paths_create() and the functions whose last argument is such a handle, and freed by
 * hp_paths_free(). It does not change, so any number of threads may use it at once, and any thread may
 * free it once the others are done.
 */
typedef struct hp_paths hp_paths;

/**
 * A medium prepared for distances and paths from any sources.
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
   * For conductivity and combined: how strongly unlike grey values are held back. For vesselness:
   * how strongly weak tubes are. Positive. Not a number (NAN), the default, stands for 3, of
   * vesselness for 2.
   */
  double power;
  /**
   * For conductivity, combined, edges and vesselness: what keeps the medium above zero. Positive.
   * Not a number (NAN), the default, stands for 0.001, of vesselness for 0.0001.
   */
  double floor;
  /**
   * For Perona-Malik and combined: the gradient, in grey values (full range 1) per pixel, at
   * which heat is held back. For vesselness: the strength of a tube whose response is 1. Positive.
   * Not a number (NAN), the default, stands for 0.03; of vesselness for the strongest tube of the
   * image, and for 0.125 if normalize is set.
   */
  double contrast;
  /**
   * For Perona-Malik and combined: HP_EDGE_STOP_EXPONENTIAL, the default, or
   * HP_EDGE_STOP_RATIONAL.
   */
  uint32_t edge_stop;
  /** For Perona-Malik, combined, edges and given: one of HP_FORM_... */
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
  /** HP_NORMALIZED, the default, HP_VARADHAN, HP_EIKONAL or HP_HEAT_METHOD. */
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
   * For HP_SOLVER_IMPLICIT and HP_HEAT_METHOD: the most bytes that a factorisation may take. 0, the default,
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
  /** For HP_MEDIUM_TENSOR: one of HP_DIRECTIONS_...; HP_DIRECTIONS_HESSIAN by default. */
  uint32_t directions;
  /**
   * For HP_MEDIUM_VESSELNESS, and HP_DIRECTIONS_HESSIAN of HP_MEDIUM_TENSOR: one of
   * HP_POLARITY_...
   */
  uint32_t polarity;
  /**
   * For HP_MEDIUM_TENSOR and HP_MEDIUM_VESSELNESS: A of eq. (14), heat is (1 + A) / (1 - A) times
   * as fast along as across. Up to 0.9998. 0, the default, stands for 0.9 of the former, and for
   * none of the latter.
   */
  double anisotropy;
  /**
   * For HP_MEDIUM_VESSELNESS: the half widths of tubes to look for, in multiples of the smallest
   * spacing; 2, 3 and 4.5 by default; hp_tube_scales() finds those of an image. For HP_MEDIUM_TENSOR:
   * one, the Gaussian before the derivatives; 2 by default. Need not be aligned.
   */
  const double *scales;
  /** How many scales there are, up to 64; 0, the default, stands for those above. */
  uint64_t scale_count;
  /**
   * For HP_MEDIUM_VESSELNESS: how much longer than wide the filter is, from 1 to 10: faint tubes
   * stand out, but take ten times as long. 0, the default, stands for 1.
   */
  double elongation;
  /**
   * For all media that see grey values: light is evened out over so many multiples of the smallest
   * spacing, the standard deviation of a Gaussian. 0, the default, leaves it as it is.
   */
  double normalize;
  /**
   * By how many multiples of the smallest spacing the walls of a mask are made thicker; 0 by
   * default. The rim of a field of view looks like a line otherwise.
   */
  double margin;
} hp_options;

/** What is known about a path besides its points. Set struct_size, then call hp_paths_info(). */
typedef struct hp_path_info {
  /** sizeof(hp_path_info). */
  uint32_t struct_size;
  /** One of HP_ENDED_... */
  uint32_t ending;
  /** Which of the sources the path ends at, counted from 0, or its label; -1 if at none. */
  int64_t source;
  /** The number of points, at least 1. */
  uint64_t point_count;
  /** The length in pixels; on a mesh, that in space. */
  double length;
  /** The length in physical units; on a mesh, that in space. */
  double physical_length;
  /** The distance of the end point from the sources, infinite if the path reaches none. */
  double distance;
  /**
   * The length of the path in the metric of the medium: its distance, if it is a shortest path. Well
   * above the distance, say 1.5 times, one of the two is wrong: heat took a short cut in a medium of
   * strong contrast, or flowed so long that it filled the image. HP_EIKONAL finds both. Not a
   * number (NAN) on meshes.
   */
  double cost;
} hp_path_info;

/**
 * The caller's list of items, described but never owned or kept. An item is one number (the number
 * of a vertex, a distance) or a few that follow each other (x, y, z; the three corners of a face).
 *
 * Fill it with hp_array_init(), then set type, data and count. Item i is found at data + i *
 * byte_stride, so a list can be a part of larger structs: the positions of vertices that have
 * colours too, say. Items need not be aligned; those that are written must not overlap.
 *
 * Any number of threads may read the same list at once. Functions that take an input only read it,
 * although data is not const.
 */
typedef struct hp_array {
  /** sizeof(hp_array). */
  uint32_t struct_size;
  /**
   * HP_U8 to HP_F64, HP_I64 or HP_U64, in the byte order of the machine. Numbers of vertices and
   * faces can have any type of integers, coordinates and values any type; results that are reals are
   * HP_F32 or HP_F64, numbers of faces and labels integers of at least 32 bits. There is no default.
   */
  uint32_t type;
  /** The first item. */
  void *data;
  /** The number of items. */
  uint64_t count;
  /**
   * The bytes from an item to the next one; negative if that one lies before it in memory. 0, the
   * default, means that items follow each other without gaps.
   */
  int64_t byte_stride;
} hp_array;

/**
 * How hp_votes_create() looks for curves. NULL in place of it means all defaults.
 *
 * Fill it with hp_vote_options_init(), then change fields. What the method does not use is ignored.
 */
typedef struct hp_vote_options {
  /** sizeof(hp_vote_options). */
  uint32_t struct_size;
  /** One of HP_VOTES_... */
  uint32_t method;
  /**
   * The squared speed of the medium from which on a pixel is part of the structure. Not a number
   * (NAN), the default: it is chosen from the medium.
   */
  double structure;
  /**
   * If no sources are given: pieces of the structure whose bounding box has at least this diagonal
   * get one. In multiples of the smallest spacing; not a number (NAN), the default, stands for a
   * sixteenth of the longest side.
   */
  double extent;
  /**
   * Anything but 0: the paper's rules alone, by which also the front votes and voting goes on into the
   * background, instead of growth that stops at the edge of the structure. 0 by default.
   */
  uint32_t no_growth;
  /**
   * With growth: pixels are kept beyond which more of the structure's pixels lie; 0, the default,
   * stands for 10.
   */
  uint32_t least_votes;
  /**
   * With growth: the longest way outside of the structure that a path may bridge, in multiples of
   * the smallest spacing. Not a number (NAN), the default, stands for 6.
   */
  double gap;
  /**
   * Without growth: pixels are kept whose density is above this part of the largest one. From 0 to
   * below 1. Not a number (NAN), the default, stands for the paper's, 1/30 or 1/7.
   */
  double threshold;
  /**
   * How far below the highest temperature heat counts as having come, in logarithms. Not a number
   * (NAN), the default, stands for 36, or 240 of the front and multiple votes.
   */
  double level;
  /**
   * Voting ends when more than this part of the kept pixels was kept before. From 0 to 1. Not a
   * number (NAN), the default, stands for 0.95, and 0.99 with growth.
   */
  double settled;
  /** The time steps of heat before each vote; 0, the default, stands for the method's own. */
  uint64_t iterations;
  /**
   * Branches with a free end that are shorter than this, in physical units, or than 1.5 radii of the
   * junction are taken off the graph; 0 by default.
   */
  double prune;
} hp_vote_options;

/**
 * How hp_key_points_create() looks for curves. NULL in place of it means all defaults.
 *
 * Fill it with hp_key_point_options_init(), then change fields.
 */
typedef struct hp_key_point_options {
  /** sizeof(hp_key_point_options). */
  uint32_t struct_size;
  /** HP_KEY_POINTS_HEAT, the default, or HP_KEY_POINTS_LENGTH. */
  uint32_t method;
  /** As in hp_vote_options; paths may run where the medium is half as fast squared, unless it is set. */
  double structure;
  /** As in hp_vote_options. */
  double extent;
  /**
   * The distance between key points, in multiples of the smallest spacing, at least 4. Not a number
   * (NAN), the default, stands for 4 half widths of the structure, from 10 to 30.
   */
  double radius;
  /**
   * For HP_KEY_POINTS_HEAT: the time steps of heat for each key point; 0, the default, stands for
   * 50, or as many as heat needs to come so far.
   */
  uint64_t iterations;
} hp_key_point_options;

/** What is known about a graph. Set struct_size, then call hp_graph_describe(). */
typedef struct hp_graph_info {
  /** sizeof(hp_graph_info). */
  uint32_t struct_size;
  /** The number of coordinates of a point, 2 or 3. */
  uint32_t dimension;
  /** The number of nodes. */
  uint64_t node_count;
  /** The number of branches. */
  uint64_t branch_count;
  /** The number of sources, given or found. */
  uint64_t source_count;
  /** The length of all branches, in physical units. */
  double physical_length;
  /** The rounds of votes; 0 without votes. */
  uint64_t rounds;
  /** Why the search ended: one of HP_STOP_... */
  uint32_t stop;
  /** 0. */
  uint32_t reserved;
} hp_graph_info;

/** An end or a junction of branches, or a key point. Set struct_size, then call hp_graph_node_at(). */
typedef struct hp_graph_node {
  /** sizeof(hp_graph_node). */
  uint32_t struct_size;
  /** How many ends of branches meet here. */
  uint32_t degree;
  /** x, y and, in a volume, z, in pixel coordinates; 0 otherwise. */
  double point[3];
  /** The radius of the structure, in physical units; not a number for key points. */
  double radius;
  /** The key point from which this one was found; -1 for sources, and if nodes are no key points. */
  int64_t parent;
} hp_graph_node;

/** A curve between two nodes. Set struct_size, then call hp_graph_branch_at(). */
typedef struct hp_graph_branch {
  /** sizeof(hp_graph_branch). */
  uint32_t struct_size;
  /** 0. */
  uint32_t reserved;
  /** The node at its first point. */
  uint64_t from;
  /** The node at its last point; the same on a closed curve. */
  uint64_t to;
  /** The number of points. */
  uint64_t point_count;
  /** The length in pixels. */
  double length;
  /** The length in physical units. */
  double physical_length;
  /** The physical length over that of the straight line between the ends; infinite on a closed curve. */
  double tortuosity;
  /** The mean of the radii along the curve, in physical units; not a number between key points. */
  double mean_radius;
} hp_graph_branch;

/**
 * Curves of the caller: polylines, or the pixels of a mask.
 *
 * Fill it with hp_curves_init(), then set points, or mask. It is only read, and not kept.
 */
typedef struct hp_curves {
  /** sizeof(hp_curves). */
  uint32_t struct_size;
  /** The number of coordinates of a point: 2, the default, or 3. That of a mask counts instead. */
  uint32_t dimension;
  /**
   * The points of all polylines, one polyline after the other; any type. An item is x, y or x, y, z
   * in pixel coordinates.
   */
  const struct hp_array *points;
  /**
   * Where the points of each polyline begin, and, last, where those of the last one end; integers.
   * NULL, the default, if there is one polyline.
   */
  const struct hp_array *starts;
  /**
   * The physical distance of neighbouring pixels along each axis, positive; 1 by default. That of a
   * mask counts instead.
   */
  double spacing[3];
  /** Instead of points: the pixels that are not 0, of which the centreline counts; any type. */
  const struct hp_buffer *mask;
} hp_curves;

/** How well curves agree. Set struct_size, then call hp_evaluate(). */
typedef struct hp_score {
  /** sizeof(hp_score). */
  uint32_t struct_size;
  /** 0. */
  uint32_t reserved;
  /**
   * The part of the truth's length within the tolerance of the extraction, 0 to 1; 1 if the truth
   * has no length.
   */
  double recall;
  /**
   * The part of the extracted length within the tolerance of the truth, 0 to 1; 1 if nothing was
   * extracted.
   */
  double precision;
  /** Their harmonic mean; 0 if both are. */
  double f1;
  /** The truth's length, in physical units. */
  double truth_length;
  /** The extraction's length, in physical units. */
  double extracted_length;
  /** The mean distance of the truth from the extraction, in physical units. */
  double truth_distance;
  /** The mean distance of the extraction from the truth, in physical units. */
  double extracted_distance;
} hp_score;

/**
 * What to compute on a mesh and how. NULL in place of it means all defaults.
 *
 * Fill it with hp_mesh_options_init(), then change fields. It is only read, and not kept; several
 * threads may use the same one if its callback allows that.
 */
typedef struct hp_mesh_options {
  /** sizeof(hp_mesh_options). */
  uint32_t struct_size;
  /**
   * The number of threads, up to 1024; 0, the default, is one per processor, and 1 the calling
   * thread alone. Results do not depend on it.
   */
  uint32_t threads;
  /** Is told how far the computation is, and may cancel it. NULL by default. */
  hp_progress progress;
  /** What the progress callback gets as its second argument. */
  void *user;
  /**
   * For hp_mesh_create(): vertices at most this far apart are joined; 0 joins those at equal
   * positions only. Not a number (NAN), the default, joins none. Files of triangles without
   * shared vertices, such as STL, need it.
   */
  double weld;
  /** For hp_mesh_solver_create(): HP_MESH_UNIFORM, the default, or another one up to HP_MESH_CREASE. */
  uint32_t medium;
  /**
   * For hp_mesh_solver_create(): HP_MESH_AUTO, the default, or another one up to
   * HP_MESH_EXPLICIT.
   */
  uint32_t method;
  /**
   * For the media that are made of values: one for each vertex or face; see hp_mesh_faces() for
   * faces. NULL by default. It is not needed any more once the solver is made.
   */
  const struct hp_array *values;
  /**
   * For HP_MESH_HEAT: how long heat flows, in multiples of the mean squared side of a face. 0, the
   * default, stands for 4 on smooth meshes, down to 0.5 where faces meet at sharp angles.
   */
  double time;
  /**
   * For HP_MESH_HEAT: the most bytes that each of two or three factorisations may take. 0, the
   * default, stands for 4 GiB.
   */
  uint64_t memory;
  /**
   * For hp_mesh_solver_create(): the distance beyond which nothing is reached. 0, the default,
   * stands for no end. It saves time with HP_MESH_EIKONAL and HP_MESH_EXACT.
   */
  double farthest;
  /**
   * For hp_mesh_curvature() and media of curvature: the radius of the ball over which it is
   * averaged. 0, the default, stands for 4 mean edges with HP_CURVATURE_NORMAL_CYCLES, and for
   * the faces at the vertex alone with HP_CURVATURE_LEAST_SQUARES.
   */
  double radius;
  /**
   * For hp_mesh_curvature() and media of curvature: HP_CURVATURE_NORMAL_CYCLES, the default, or
   * HP_CURVATURE_LEAST_SQUARES.
   */
  uint32_t curvature;
  /**
   * For paths: anything but 0 makes them locally shortest, straight across all edges. For
   * HP_MESH_UNIFORM only. 0 by default.
   */
  uint32_t shorten;
  /**
   * For HP_MESH_CURVATURE and HP_MESH_CREASE: HP_BEND_BOTH, the default, HP_BEND_CONVEX or
   * HP_BEND_CONCAVE.
   */
  uint32_t bend;
  /** 0. */
  uint32_t reserved;
  /**
   * For scalars, curvature and crease: what keeps P above zero. Not a number (NAN), the default,
   * stands for 0.001 with scalars, and for 0.01 with the others, where it is at most 1.
   */
  double floor;
  /**
   * For scalars, curvature and crease: the power, positive. Not a number (NAN), the default,
   * stands for 3 with scalars, and for 1 with the others.
   */
  double power;
  /**
   * For curvature and crease: the part of the vertices that bend less than what counts as fully
   * bent; above 0, at most 1. 0.99 by default.
   */
  double quantile;
  /** For scalars: the value f that the others are compared with. There is no default. */
  double reference;
  /**
   * For HP_MESH_EXPLICIT: the number of time steps, up to 10^9. 0, the default, stands for enough to
   * reach all vertices.
   */
  uint64_t iterations;
  /**
   * For HP_MESH_EXPLICIT: the time step, where P is 1 the mean number of edges that heat goes in
   * one. Not a number (NAN), the default, stands for 0.2, or less where that is unstable; 0 takes a
   * safe fraction of the largest one that is stable.
   */
  double step;
} hp_mesh_options;

/**
 * Points on the surface of a mesh: vertices, or positions in space, or places on faces.
 *
 * Fill it with hp_surface_points_init(), then set one of vertices, positions, or faces with weights,
 * and leave the others NULL. It is only read, and not kept.
 */
typedef struct hp_surface_points {
  /** sizeof(hp_surface_points). */
  uint32_t struct_size;
  /**
   * For sources at positions: anything but 0 makes them a curve, with straight lines between
   * them that are laid onto the surface; all of it is one source, 0. offsets, labels and sets must
   * be NULL then. 0 by default.
   */
  uint32_t curve;
  /** The numbers of vertices; integers. */
  const struct hp_array *vertices;
  /** x, y, z of points in space: the nearest point of the surface is taken. */
  const struct hp_array *positions;
  /** The numbers of the faces that the points lie on; integers. */
  const struct hp_array *faces;
  /**
   * The weights of the three corners of those faces (barycentric coordinates): not negative, adding
   * up to 1.
   */
  const struct hp_array *weights;
  /** For sources: the distance at each of them. NULL, the default, is 0 for all. */
  const struct hp_array *offsets;
  /**
   * For sources: how they are called in results, integers from 0 to 2147483647. NULL, the default,
   * are their numbers. The points of a curve should share a label: with HP_MESH_HEAT the
   * time grows with the number of labels.
   */
  const struct hp_array *labels;
  /**
   * For sources of distances: where each set begins, and, last, where the last one ends: one
   * more number than there are sets. The sources of a set count together, and each set has its
   * own map. NULL, the default, makes all sources one set.
   */
  const struct hp_array *sets;
} hp_surface_points;

/** What hp_mesh_create() found. Set struct_size, then call hp_mesh_describe(). */
typedef struct hp_mesh_report {
  /** sizeof(hp_mesh_report). */
  uint32_t struct_size;
  /** 0. */
  uint32_t reserved;
  /** The vertices of the caller; results have one number for each of them. */
  uint64_t vertices;
  /** The faces of the mesh, all of them triangles, see hp_mesh_faces(). */
  uint64_t faces;
  /** Vertices that were joined with an earlier one. */
  uint64_t welded;
  /**
   * Vertices at the position of an earlier one that were not joined: the mesh may be torn there,
   * see hp_mesh_options.weld.
   */
  uint64_t shared_positions;
  /** Polygons of more than three corners that were cut into triangles. */
  uint64_t polygons;
  /** Dropped faces with fewer than three different vertices. */
  uint64_t repeated;
  /** Dropped faces with the same three vertices as an earlier one. */
  uint64_t duplicates;
  /** Faces without area; they were kept. */
  uint64_t flat;
  /** Vertices that no face uses: they are at no distance from anywhere. */
  uint64_t unreferenced;
  /** Edges with more than two faces. */
  uint64_t non_manifold_edges;
  /** Edges with one face. */
  uint64_t border_edges;
  /** Edges whose faces do not agree about what is outside. */
  uint64_t inconsistent_edges;
  /** Components; between them there is no distance. */
  uint64_t components;
  /** Vertices that faces use - edges + faces: 2 for a closed surface without handles. */
  int64_t euler_characteristic;
} hp_mesh_report;

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
 * Writes the medium that the options make of an image, without letting heat flow in it.
 *
 * image, mask, sources, source_count and options are those of hp_distance(). Sources are needed only
 * by HP_MEDIUM_CONDUCTIVITY and HP_MEDIUM_COMBINED without a reference; else they may be NULL.
 *
 * squared_speed: receives k D, the square of the speed; of the same size, HP_F32 or HP_F64. Where D is
 * a matrix it is the geometric mean over its principal directions. 0 in walls.
 *
 * The caller promises:
 * As hp_distance().
 */
hp_status hp_medium(const struct hp_buffer *image,
                    const struct hp_buffer *mask,
                    const double *sources,
                    uint64_t source_count,
                    const struct hp_options *options,
                    const struct hp_buffer *squared_speed);

/**
 * Finds the scales for HP_MEDIUM_VESSELNESS from the tubes that the image shows.
 *
 * Tubes are looked for at scales from 1 to an eighth of the shortest side. Along the middle of what is
 * long and strong each pixel votes for the scale of its strongest response; the scales have a sixth, a half
 * and five sixths of the votes below them. Uneven light looks like a wide tube: set hp_options.normalize.
 *
 * image, mask and options are those of hp_distance(). The medium must be HP_MEDIUM_VESSELNESS; its polarity
 * counts, its scales do not.
 *
 * scales: room for HP_MOST_TUBE_SCALES numbers. Receives the scales in ascending order, to be set as
 * hp_options.scales; need not be aligned.
 *
 * count: receives how many there are, from 1. Need not be aligned.
 *
 * HP_NO_ANSWER is returned if the image shows nothing long.
 *
 * The caller promises:
 * As hp_distance(). scales and count must be NULL or point to memory that can be written.
 */
hp_status hp_tube_scales(const struct hp_buffer *image,
                         const struct hp_buffer *mask,
                         const struct hp_options *options,
                         double *scales,
                         uint64_t *count);

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
 * paths is NULL or comes from one of the functions that make paths, and was not freed yet.
 */
void hp_paths_free(struct hp_paths *paths);

/**
 * Writes the number of paths to *count.
 *
 * The caller promises:
 * paths is NULL or comes from one of the functions that make paths; count is NULL or points to a uint64_t.
 */
hp_status hp_paths_count(const struct hp_paths *paths,
                         uint64_t *count);

/**
 * Writes what is known about a path to *info, whose struct_size must be set.
 *
 * The caller promises:
 * paths is NULL or comes from one of the functions that make paths; info is NULL or points to as many bytes as
 * its struct_size says.
 */
hp_status hp_paths_info(const struct hp_paths *paths,
                        uint64_t index,
                        struct hp_path_info *info);

/**
 * Copies the points of a path, in pixel coordinates or those of the mesh, from the end point
 * to the source.
 *
 * coordinates: receives x, y of each point or, of a volume or mesh, x, y, z: two or three
 * times as many doubles as hp_path_info.point_count says.
 *
 * capacity: how many points there is room for. If it is too small nothing is written.
 *
 * The caller promises:
 * paths is NULL or comes from one of the functions that make paths; coordinates is NULL or has room for
 * capacity points of two or, of a volume or mesh, three doubles.
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
 * is HP_EIKONAL, HP_HEAT_METHOD or another: a solver gives distances of its own kind only.
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
 * HP_EIKONAL or HP_HEAT_METHOD the estimator does not; the rest was fixed when the solver was made. NULL
 * for the defaults. With HP_SOLVER_IMPLICIT sources are shared between the threads; the results do not
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
 * Traces the minimal path from each end point to a source, as hp_paths_create() does, in a medium that
 * was prepared once.
 *
 * sources, ends: source_count and end_count points, as for hp_paths_create().
 *
 * options: as for hp_solver_distances().
 *
 * paths: receives the paths, to be freed with hp_paths_free(), or NULL if anything but HP_OK is
 * returned.
 *
 * The caller promises:
 * solver is NULL or comes from hp_solver_create() and was not freed yet. The structs are as
 * large as their struct_size says, and the points are as large as their description.
 */
hp_status hp_solver_paths_create(const struct hp_solver *solver,
                                 const double *sources,
                                 uint64_t source_count,
                                 const double *ends,
                                 uint64_t end_count,
                                 const struct hp_options *options,
                                 struct hp_paths **paths);

/**
 * Frees a solver; NULL is fine.
 *
 * The caller promises:
 * solver is NULL or comes from hp_solver_create() and was not freed yet.
 */
void hp_solver_free(struct hp_solver *solver);

/**
 * Computes how far every pixel is from the nearest of several sources, which one that is, and how
 * surely.
 *
 * sources: source_count points, as for hp_distance().
 *
 * options: as for hp_solver_distances().
 *
 * distance: receives the distance from the nearest source, as hp_distance() does. NULL if it is not
 * wanted.
 *
 * labels: receives the number of the nearest source, counted from 0, and -1 where none is reached; of
 * the same size, HP_I32, or HP_U32 with the bits of -1. NULL if they are not wanted.
 *
 * shares: describes the first of source_count maps, HP_F32 or HP_F64, that receive the share of each
 * source in every pixel, from 0 to 1: 1/2 where two of them are equally near, turning to 0 and 1
 * within some sqrt(t) of there, and 0 where none is reached. NULL if they are not wanted.
 *
 * share_stride: the bytes from a map of shares to the next one, as map_stride of
 * hp_solver_distances().
 *
 * Labels are those of heat and of HP_EIKONAL, shares of heat alone. With heat both are as HP_NORMALIZED
 * sees them, whatever the estimator, and take 25 bytes for each pixel and source meanwhile. Nothing is
 * written unless HP_OK is returned.
 *
 * The caller promises:
 * As hp_solver_distances().
 */
hp_status hp_solver_nearest(const struct hp_solver *solver,
                            const double *sources,
                            uint64_t source_count,
                            const struct hp_options *options,
                            const struct hp_buffer *distance,
                            const struct hp_buffer *labels,
                            const struct hp_buffer *shares,
                            int64_t share_stride);

/**
 * Computes the distance from each of some points to each of others: a row for each of from, with a
 * number for each of to.
 *
 * from, to: from_count and to_count points, as for hp_distance().
 *
 * options: as for hp_solver_distances(). With HP_SOLVER_IMPLICIT points are shared between the
 * threads; the results do not depend on how many there are.
 *
 * distances: describes the first row: to_count numbers, HP_F32 or HP_F64. They are infinite where no
 * heat arrives, in the pixels around a point or at all.
 *
 * row_stride: the bytes from a row to the next one. 0 means that rows follow each other without
 * gaps.
 *
 * From a to b is as far as from b to a up to the error of the method. If the call is cancelled a part
 * may have been written; after any other failure nothing was.
 *
 * The caller promises:
 * solver is NULL or comes from hp_solver_create() and was not freed yet. The structs are as
 * large as their struct_size says, and the points and the list are as large as their description.
 * The results are not used by another thread meanwhile.
 */
hp_status hp_solver_matrix(const struct hp_solver *solver,
                           const double *from,
                           uint64_t from_count,
                           const double *to,
                           uint64_t to_count,
                           const struct hp_options *options,
                           const struct hp_array *distances,
                           int64_t row_stride);

/**
 * Computes where heat passes on its way from one end to the other: a path with a width. Where there are
 * several ways, all show.
 *
 * solver: one of heat, without HP_EIKONAL and HP_HEAT_METHOD.
 *
 * from, to: the two ends, from_count and to_count points, as for hp_distance(); usually one each.
 *
 * options: threads, progress and user count. NULL for the defaults.
 *
 * ln_density: receives the logarithm of the time that a particle of heat that goes from one end to the
 * other spends in a pixel, in units of the time step: it is largest along the minimal path, and
 * minus infinity where no heat of both ends comes. Of the same size, HP_F32 or HP_F64. It is
 * written only if HP_OK is returned.
 *
 * HP_NO_ANSWER is returned if no heat from one end reaches the other.
 *
 * The caller promises:
 * As hp_solver_distances().
 */
hp_status hp_solver_bridge(const struct hp_solver *solver,
                           const double *from,
                           uint64_t from_count,
                           const double *to,
                           uint64_t to_count,
                           const struct hp_options *options,
                           const struct hp_buffer *ln_density);

/**
 * Fills *options with the defaults; struct_size is sizeof(hp_vote_options).
 *
 * The caller promises:
 * options is NULL or points to struct_size writable bytes.
 */
hp_status hp_vote_options_init(struct hp_vote_options *options, uint32_t struct_size);

/**
 * Fills *options with the defaults; struct_size is sizeof(hp_key_point_options).
 *
 * The caller promises:
 * options is NULL or points to struct_size writable bytes.
 */
hp_status hp_key_point_options_init(struct hp_key_point_options *options, uint32_t struct_size);

/**
 * Frees a graph; NULL is fine.
 *
 * The caller promises:
 * graph is NULL or comes from one of the functions that make graphs, and was not freed yet.
 */
void hp_graph_free(struct hp_graph *graph);

/**
 * Writes what is known about a graph to *info, whose struct_size must be set.
 *
 * The caller promises:
 * graph is NULL or comes from one of the functions that make graphs; info is NULL or points to
 * as many bytes as its struct_size says.
 */
hp_status hp_graph_describe(const struct hp_graph *graph, struct hp_graph_info *info);

/**
 * Writes what is known about a node to *node, whose struct_size must be set.
 *
 * The caller promises:
 * As hp_graph_describe().
 */
hp_status hp_graph_node_at(const struct hp_graph *graph,
                           uint64_t index,
                           struct hp_graph_node *node);

/**
 * Writes what is known about a branch to *branch, whose struct_size must be set.
 *
 * The caller promises:
 * As hp_graph_describe().
 */
hp_status hp_graph_branch_at(const struct hp_graph *graph,
                             uint64_t index,
                             struct hp_graph_branch *branch);

/**
 * Copies the points of a branch, in pixel coordinates, and the radii there.
 *
 * coordinates: receives x, y or x, y, z of each point: hp_graph_info.dimension times as many doubles as
 * hp_graph_branch.point_count says.
 *
 * radii: receives a radius for each point, in physical units, not a number between key points. NULL
 * if they are not wanted.
 *
 * capacity: for how many points there is room.
 *
 * The caller promises:
 * graph is NULL or comes from one of the functions that make graphs; coordinates and radii are
 * NULL or have room for capacity points.
 */
hp_status hp_graph_branch_points(const struct hp_graph *graph,
                                 uint64_t index,
                                 double *coordinates,
                                 double *radii,
                                 uint64_t capacity);

/**
 * Copies the sources, given or found, in pixel coordinates.
 *
 * coordinates: receives x, y or x, y, z of each: hp_graph_info.dimension times as many doubles as
 * hp_graph_info.source_count says.
 *
 * capacity: for how many points there is room.
 *
 * The caller promises:
 * graph is NULL or comes from one of the functions that make graphs; coordinates is NULL or has
 * room for capacity points.
 */
hp_status hp_graph_sources(const struct hp_graph *graph, double *coordinates, uint64_t capacity);

/**
 * Finds the curves of an image by the votes of many minimal paths (section 4.1 of the paper), as a graph
 * with radii.
 *
 * image, mask, sources, source_count and options are those of hp_distance(), of which medium, range,
 * threads and progress count. Without sources (NULL, 0) there is a seed in each long piece of the
 * structure.
 *
 * vote_options: NULL for the defaults.
 *
 * density: receives the number of paths through each pixel; of the same size, HP_F32 or HP_F64. NULL
 * if it is not wanted.
 *
 * kept: receives 255 in the pixels of the curves and 0 elsewhere; of the same size, HP_U8. NULL if it
 * is not wanted.
 *
 * graph: receives the curves, to be freed with hp_graph_free(), or NULL if anything but HP_OK is
 * returned.
 *
 * HP_NO_ANSWER is returned if there are no sources and the image shows no structure to put them on.
 *
 * The caller promises:
 * The structs are as large as their struct_size says, and buffers and points are as large as
 * their description. The results are not used by another thread meanwhile.
 */
hp_status hp_votes_create(const struct hp_buffer *image,
                          const struct hp_buffer *mask,
                          const double *sources,
                          uint64_t source_count,
                          const struct hp_options *options,
                          const struct hp_vote_options *vote_options,
                          const struct hp_buffer *density,
                          const struct hp_buffer *kept,
                          struct hp_graph **graph);

/**
 * Finds the curves of an image from key point to key point (section 4.2 of the paper), as a graph whose
 * nodes are the key points.
 *
 * image, mask, sources, source_count and options are those of hp_votes_create().
 *
 * key_point_options: NULL for the defaults.
 *
 * graph: receives the key points and the paths between them, to be freed with hp_graph_free(), or
 * NULL if anything but HP_OK is returned. The first nodes are the sources, or the seeds that were
 * found; all other nodes have a parent, to which a branch leads. Branches between nodes neither of
 * which is the parent of the other close a curve.
 *
 * HP_NO_ANSWER is returned if the image shows no structure.
 *
 * The caller promises:
 * The structs are as large as their struct_size says, and buffers and points are as large as
 * their description.
 */
hp_status hp_key_points_create(const struct hp_buffer *image,
                               const struct hp_buffer *mask,
                               const double *sources,
                               uint64_t source_count,
                               const struct hp_options *options,
                               const struct hp_key_point_options *key_point_options,
                               struct hp_graph **graph);

/**
 * Makes a graph of the centreline of a mask, with the distances to its edge as radii.
 *
 * mask: the pixels that are not 0; any type.
 *
 * prune: branches with a free end that are shorter than this, in physical units, or than 1.5 radii of the
 * junction are taken off.
 *
 * graph: receives the graph, to be freed with hp_graph_free(), or NULL if anything but HP_OK is
 * returned.
 *
 * The caller promises:
 * The struct is as large as its struct_size says, and the buffer is as large as its description.
 */
hp_status hp_skeleton_create(const struct hp_buffer *mask,
                             double prune,
                             struct hp_graph **graph);

/**
 * Fills *array with the defaults; struct_size is sizeof(hp_array).
 *
 * The caller promises:
 * array is NULL or points to struct_size writable bytes.
 */
hp_status hp_array_init(struct hp_array *array, uint32_t struct_size);

/**
 * Fills *curves with the defaults; struct_size is sizeof(hp_curves).
 *
 * The caller promises:
 * curves is NULL or points to struct_size writable bytes.
 */
hp_status hp_curves_init(struct hp_curves *curves, uint32_t struct_size);

/**
 * Compares extracted curves with a truth: recall and precision by length.
 *
 * extracted, truth: of the same dimension and spacing.
 *
 * view: pixels that are 0 do not count, on either side; any type. NULL if all do.
 *
 * tolerance: the largest distance at which curves agree, in physical units; from 0.
 *
 * score: receives the answer; its struct_size must be set.
 *
 * The caller promises:
 * The structs are as large as their struct_size says, and buffers and lists are as large as their
 * description.
 */
hp_status hp_evaluate(const struct hp_curves *extracted,
                      const struct hp_curves *truth,
                      const struct hp_buffer *view,
                      double tolerance,
                      struct hp_score *score);

/**
 * Fills *options with the defaults; struct_size is sizeof(hp_mesh_options).
 *
 * The caller promises:
 * options is NULL or points to struct_size writable bytes.
 */
hp_status hp_mesh_options_init(struct hp_mesh_options *options, uint32_t struct_size);

/**
 * Fills *points with NULL pointers; struct_size is sizeof(hp_surface_points).
 *
 * The caller promises:
 * points is NULL or points to struct_size writable bytes.
 */
hp_status hp_surface_points_init(struct hp_surface_points *points, uint32_t struct_size);

/**
 * Makes a mesh from the caller's points and faces, which are not needed any more when this returns.
 *
 * Vertices are always those of the caller, counted from 0: all results have one number for each of
 * them, also if some were joined. Borders, edges with more than two faces, several components,
 * faces of any orientation and vertices without faces are all fine. Faces with the same vertex
 * twice, and all but the first of faces with the same three vertices, are dropped. Faces are
 * counted in the mesh: if some were dropped or cut, hp_mesh_faces() tells which there are.
 *
 * points: x, y, z of each vertex, finite, up to 1e100; any type.
 *
 * faces: three vertices each, counter-clockwise as seen from outside; any type of integers. With
 * starts, one vertex each: the corners of all polygons, one polygon after the other.
 *
 * starts: NULL for triangles. For polygons, where the corners of each one begin in faces, and,
 * last, where those of the last one end: one more number than there are polygons (the offsets of a
 * vtkCellArray). Polygons are cut into triangles.
 *
 * options: weld counts. NULL for the defaults.
 *
 * mesh: receives the mesh, to be freed with hp_mesh_free(), or NULL if anything but HP_OK is
 * returned.
 *
 * The caller promises:
 * The structs are as large as their struct_size says, and lists are as large as their
 * description.
 */
hp_status hp_mesh_create(const struct hp_array *points,
                         const struct hp_array *faces,
                         const struct hp_array *starts,
                         const struct hp_mesh_options *options,
                         struct hp_mesh **mesh);

/**
 * Frees a mesh; NULL is fine.
 *
 * The caller promises:
 * mesh is NULL or comes from hp_mesh_create() and was not freed yet.
 */
void hp_mesh_free(struct hp_mesh *mesh);

/**
 * Writes what a mesh is like to *report, whose struct_size must be set.
 *
 * The caller promises:
 * mesh is NULL or comes from hp_mesh_create(); report is NULL or points to as many bytes as
 * its struct_size says.
 */
hp_status hp_mesh_describe(const struct hp_mesh *mesh, struct hp_mesh_report *report);

/**
 * Copies the faces of a mesh.
 *
 * faces: receives the three vertices of each face; hp_mesh_report.faces items of HP_I32, HP_U32,
 * HP_I64 or HP_U64. Of joined vertices it is the first one.
 *
 * The caller promises:
 * mesh is NULL or comes from hp_mesh_create(); the list is as large as its description.
 */
hp_status hp_mesh_faces(const struct hp_mesh *mesh, const struct hp_array *faces);

/**
 * Prepares distances on a mesh from sources that are not known yet; with HP_MESH_HEAT, analyses and
 * factors the systems.
 *
 * mesh: may be freed before the solver.
 *
 * options: all but weld and shorten count. NULL for the defaults.
 *
 * solver: receives the solver, to be freed with hp_mesh_solver_free(), or NULL if anything but
 * HP_OK is returned. HP_OUT_OF_MEMORY means that the mesh is too large for HP_MESH_HEAT; the
 * message names the memory that it needs.
 *
 * The caller promises:
 * mesh is NULL or comes from hp_mesh_create(). The structs are as large as their struct_size
 * says, and lists are as large as their description.
 */
hp_status hp_mesh_solver_create(const struct hp_mesh *mesh,
                                const struct hp_mesh_options *options,
                                struct hp_mesh_solver **solver);

/**
 * Frees a solver; NULL is fine.
 *
 * The caller promises:
 * solver is NULL or comes from hp_mesh_solver_create() and was not freed yet.
 */
void hp_mesh_solver_free(struct hp_mesh_solver *solver);

/**
 * Writes the method of a solver to *method: HP_MESH_HEAT, HP_MESH_EIKONAL, HP_MESH_EXACT or
 * HP_MESH_EXPLICIT.
 *
 * The caller promises:
 * solver is NULL or comes from hp_mesh_solver_create(); method is NULL or points to a uint32_t.
 */
hp_status hp_mesh_solver_method(const struct hp_mesh_solver *solver, uint32_t *method);

/**
 * Computes the distance of every vertex from the nearest source of a set, for one or more sets.
 *
 * sources: the sets of sources, see hp_surface_points.sets.
 *
 * options: threads and progress count; the results do not depend on the number of threads. NULL for the defaults.
 *
 * distances: receives the distances of the first set, one for each vertex; HP_F32 or HP_F64.
 * Distances are in units of the points times slowness, and infinite where there is no way, beyond
 * hp_mesh_options.farthest, and at vertices that no face uses.
 *
 * map_stride: the bytes from the distances of a set to those of the next one. 0 means that they
 * follow each other without gaps.
 *
 * labels: receives the label of the nearest source for each vertex, -1 where there is none; HP_I32,
 * HP_U32, HP_I64 or HP_U64, the bits of -1 set in all of them. NULL if they are not wanted.
 *
 * label_stride: as map_stride, for labels.
 *
 * If the call is cancelled some of the maps may have been written; after any other failure none
 * was.
 *
 * The caller promises:
 * solver is NULL or comes from hp_mesh_solver_create(). The structs are as large as their
 * struct_size says, and lists are as large as their description. The results are not used by
 * another thread meanwhile.
 */
hp_status hp_mesh_solver_distances(const struct hp_mesh_solver *solver,
                                   const struct hp_surface_points *sources,
                                   const struct hp_mesh_options *options,
                                   const struct hp_array *distances,
                                   int64_t map_stride,
                                   const struct hp_array *labels,
                                   int64_t label_stride);

/**
 * Computes the distances between all vertices: row i of the matrix holds those from vertex i.
 *
 * They are those of hp_mesh_solver_distances() with every vertex as a set; they agree with their
 * counterparts on the other side of the diagonal up to the error of the method.
 *
 * options: threads and progress count; the results do not depend on the number of threads. NULL for the defaults.
 *
 * distances: receives the first row, one number for each vertex; HP_F32 or HP_F64.
 *
 * row_stride: the bytes from a row to the next one. 0 means that rows follow each other without
 * gaps.
 *
 * If the call is cancelled a part may have been written; after any other failure nothing was.
 *
 * The caller promises:
 * As hp_mesh_solver_distances().
 */
hp_status hp_mesh_solver_matrix(const struct hp_mesh_solver *solver,
                                const struct hp_mesh_options *options,
                                const struct hp_array *distances,
                                int64_t row_stride);

/**
 * Traces the shortest path from each end point to a source.
 *
 * sources: one set of them; see hp_surface_points.
 *
 * ends: the end points.
 *
 * options: shorten, threads and progress count. NULL for the defaults.
 *
 * paths: receives the paths, in the order of the ends, to be freed with hp_paths_free(), or NULL
 * if anything but HP_OK is returned. Their points are x, y, z, from the end to the source; two
 * neighbours share a face. hp_path_info.source is the label of the source, and both lengths are
 * that in space; the distance is that of the solver, also if the path was shortened.
 *
 * An end point from which no source can be reached is not an error: hp_path_info tells.
 *
 * The caller promises:
 * solver is NULL or comes from hp_mesh_solver_create(). The structs are as large as their
 * struct_size says, and lists are as large as their description.
 */
hp_status hp_mesh_paths_create(const struct hp_mesh_solver *solver,
                               const struct hp_surface_points *sources,
                               const struct hp_surface_points *ends,
                               const struct hp_mesh_options *options,
                               struct hp_paths **paths);

/**
 * Traces the path through some points in their order.
 *
 * points: two or more. The path goes from the first one to the last one and passes through the
 * others; each piece is the shortest one, and hp_mesh_options.shorten straightens each by itself.
 *
 * paths: receives one path as hp_mesh_paths_create() makes them; its source is the number of the
 * last point. Where a piece does not reach its point the path ends, and hp_path_info tells.
 *
 * options: as for hp_mesh_paths_create().
 *
 * The caller promises:
 * As hp_mesh_paths_create().
 */
hp_status hp_mesh_paths_through(const struct hp_mesh_solver *solver,
                                const struct hp_surface_points *points,
                                const struct hp_mesh_options *options,
                                struct hp_paths **paths);

/**
 * Finds the curves along which a function of the vertices has one of some values.
 *
 * values: the function, one value for each vertex, finite or infinite where it has none; linear on
 * each face.
 *
 * levels: the values to look for; finite.
 *
 * isolines: receives the curves, those of the first level first, to be freed with hp_paths_free(),
 * or NULL if anything but HP_OK is returned. There can be any number for a level. Of
 * hp_path_info, ending is HP_ENDED_CLOSED, where the last point is joined to the first, or
 * HP_ENDED_OPEN; source is the number of the level, and distance the level.
 *
 * The caller promises:
 * mesh is NULL or comes from hp_mesh_create(). The lists are as large as their description.
 */
hp_status hp_mesh_isolines_create(const struct hp_mesh *mesh,
                                  const struct hp_array *values,
                                  const struct hp_array *levels,
                                  struct hp_paths **isolines);

/**
 * Tells where points lie on the surface of a mesh: of positions in space the nearest point of it.
 *
 * points: see hp_surface_points; no curve.
 *
 * faces: receives the number of a face for each point; HP_I32, HP_U32, HP_I64 or HP_U64. NULL if it
 * is not wanted.
 *
 * weights: receives the weights of the three corners of that face; HP_F32 or HP_F64. NULL if they are
 * not wanted.
 *
 * positions: receives x, y, z in space; HP_F32 or HP_F64. NULL if they are not wanted.
 *
 * The caller promises:
 * mesh is NULL or comes from hp_mesh_create(). The structs are as large as their struct_size
 * says, and lists are as large as their description. The results are not used by another thread
 * meanwhile.
 */
hp_status hp_mesh_locate(const struct hp_mesh *mesh,
                         const struct hp_surface_points *points,
                         const struct hp_array *faces,
                         const struct hp_array *weights,
                         const struct hp_array *positions);

/**
 * Copies the points of a path or curve on a mesh as places on its faces, which hp_surface_points
 * takes again.
 *
 * faces, weights: as for hp_mesh_locate(), hp_path_info.point_count items each.
 *
 * The caller promises:
 * paths is NULL or comes from one of the functions that make paths; the lists are as large as
 * their description.
 */
hp_status hp_paths_places(const struct hp_paths *paths,
                          uint64_t index,
                          const struct hp_array *faces,
                          const struct hp_array *weights);

/**
 * Makes a closed curve on a mesh locally shortest: a closed geodesic, such as around a handle or a
 * neck.
 *
 * points: the curve, by its points in their order; two neighbours share a face, and so do the last
 * and the first. hp_paths_places() gives such points of an isoline, or of a path through points that
 * comes back to its first one.
 *
 * loops: receives one curve, whose ending is HP_ENDED_CLOSED, or none if it contracts to a point; to
 * be freed with hp_paths_free(), or NULL if anything but HP_OK is returned.
 *
 * The caller promises:
 * mesh is NULL or comes from hp_mesh_create(). The structs are as large as their struct_size
 * says, and lists are as large as their description.
 */
hp_status hp_mesh_loop_create(const struct hp_mesh *mesh,
                              const struct hp_surface_points *points,
                              struct hp_paths **loops);

/**
 * Computes the principal curvatures at each vertex, in 1 / unit of the points: positive where the
 * surface is convex as seen from outside, where faces are counter-clockwise.
 *
 * options: curvature, radius, threads and progress count. NULL for the defaults.
 *
 * smallest, largest: receive the smaller and the larger one, with their signs; one number for each
 * vertex, HP_F32 or HP_F64. NULL for what is not wanted.
 *
 * smallest_directions, largest_directions: receive the unit tangents in which the surface bends so,
 * x, y, z for each vertex; zero where there is no tangent plane. A crease runs along the direction
 * of the curvature of smaller size. NULL for what is not wanted.
 *
 * The caller promises:
 * mesh is NULL or comes from hp_mesh_create(). The structs are as large as their struct_size
 * says, and lists are as large as their description. The results are not used by another thread
 * meanwhile.
 */
hp_status hp_mesh_curvature(const struct hp_mesh *mesh,
                            const struct hp_mesh_options *options,
                            const struct hp_array *smallest,
                            const struct hp_array *largest,
                            const struct hp_array *smallest_directions,
                            const struct hp_array *largest_directions);

/**
 * The table of all functions, or NULL if the library has another ABI than the caller.
 *
 * abi_version: HP_ABI_VERSION of the header that the caller was compiled with.
 *
 * The table belongs to the library and lives as long as it is loaded. A library that is older than
 * the header may have a shorter table: what lies beyond hp_api.struct_size is not there.
 */
const struct hp_api *hp_get_api(uint32_t abi_version);

struct hp_api {
  /** The size of the table, in bytes. */
  uint32_t struct_size;
  /** The HP_ABI_VERSION of the library. */
  uint32_t abi;
  uint32_t (*abi_version)(void);
  const char *(*version_string)(void);
  const char *(*last_error_message)(void);
  const char *(*status_name)(hp_status status);
  hp_status (*buffer_init)(struct hp_buffer *buffer, uint32_t struct_size);
  hp_status (*options_init)(struct hp_options *options, uint32_t struct_size);
  hp_status (*distance)(const struct hp_buffer *image, const struct hp_buffer *mask,
      const double *sources, uint64_t source_count, const struct hp_options *options,
      const struct hp_buffer *distance);
  hp_status (*medium)(const struct hp_buffer *image, const struct hp_buffer *mask,
      const double *sources, uint64_t source_count, const struct hp_options *options,
      const struct hp_buffer *squared_speed);
  hp_status (*paths_create)(const struct hp_buffer *image, const struct hp_buffer *mask,
      const double *sources, uint64_t source_count, const double *ends, uint64_t end_count,
      const struct hp_options *options, struct hp_paths **paths);
  void (*paths_free)(struct hp_paths *paths);
  hp_status (*paths_count)(const struct hp_paths *paths, uint64_t *count);
  hp_status (*paths_info)(const struct hp_paths *paths, uint64_t index, struct hp_path_info *info);
  hp_status (*paths_points)(const struct hp_paths *paths, uint64_t index, double *coordinates,
      uint64_t capacity);
  hp_status (*solver_create)(const struct hp_buffer *image, const struct hp_buffer *mask,
      const struct hp_options *options, struct hp_solver **solver);
  hp_status (*solver_distances)(const struct hp_solver *solver, const double *sources,
      uint64_t source_count, const struct hp_options *options, const struct hp_buffer *distances,
      int64_t map_stride);
  hp_status (*solver_paths_create)(const struct hp_solver *solver, const double *sources,
      uint64_t source_count, const double *ends, uint64_t end_count,
      const struct hp_options *options, struct hp_paths **paths);
  void (*solver_free)(struct hp_solver *solver);
  hp_status (*vote_options_init)(struct hp_vote_options *options, uint32_t struct_size);
  hp_status (*key_point_options_init)(struct hp_key_point_options *options, uint32_t struct_size);
  hp_status (*votes_create)(const struct hp_buffer *image, const struct hp_buffer *mask,
      const double *sources, uint64_t source_count, const struct hp_options *options,
      const struct hp_vote_options *vote_options, const struct hp_buffer *density,
      const struct hp_buffer *kept, struct hp_graph **graph);
  hp_status (*key_points_create)(const struct hp_buffer *image, const struct hp_buffer *mask,
      const double *sources, uint64_t source_count, const struct hp_options *options,
      const struct hp_key_point_options *key_point_options, struct hp_graph **graph);
  hp_status (*skeleton_create)(const struct hp_buffer *mask, double prune, struct hp_graph **graph);
  hp_status (*graph_describe)(const struct hp_graph *graph, struct hp_graph_info *info);
  hp_status (*graph_node_at)(const struct hp_graph *graph, uint64_t index,
      struct hp_graph_node *node);
  hp_status (*graph_branch_at)(const struct hp_graph *graph, uint64_t index,
      struct hp_graph_branch *branch);
  hp_status (*graph_branch_points)(const struct hp_graph *graph, uint64_t index,
      double *coordinates, double *radii, uint64_t capacity);
  hp_status (*graph_sources)(const struct hp_graph *graph, double *coordinates, uint64_t capacity);
  void (*graph_free)(struct hp_graph *graph);
  hp_status (*curves_init)(struct hp_curves *curves, uint32_t struct_size);
  hp_status (*evaluate)(const struct hp_curves *extracted, const struct hp_curves *truth,
      const struct hp_buffer *view, double tolerance, struct hp_score *score);
  hp_status (*array_init)(struct hp_array *array, uint32_t struct_size);
  hp_status (*mesh_options_init)(struct hp_mesh_options *options, uint32_t struct_size);
  hp_status (*surface_points_init)(struct hp_surface_points *points, uint32_t struct_size);
  hp_status (*mesh_create)(const struct hp_array *points, const struct hp_array *faces,
      const struct hp_array *starts, const struct hp_mesh_options *options, struct hp_mesh **mesh);
  void (*mesh_free)(struct hp_mesh *mesh);
  hp_status (*mesh_describe)(const struct hp_mesh *mesh, struct hp_mesh_report *report);
  hp_status (*mesh_faces)(const struct hp_mesh *mesh, const struct hp_array *faces);
  hp_status (*mesh_solver_create)(const struct hp_mesh *mesh, const struct hp_mesh_options *options,
      struct hp_mesh_solver **solver);
  void (*mesh_solver_free)(struct hp_mesh_solver *solver);
  hp_status (*mesh_solver_method)(const struct hp_mesh_solver *solver, uint32_t *method);
  hp_status (*mesh_solver_distances)(const struct hp_mesh_solver *solver,
      const struct hp_surface_points *sources, const struct hp_mesh_options *options,
      const struct hp_array *distances, int64_t map_stride, const struct hp_array *labels,
      int64_t label_stride);
  hp_status (*mesh_solver_matrix)(const struct hp_mesh_solver *solver,
      const struct hp_mesh_options *options, const struct hp_array *distances, int64_t row_stride);
  hp_status (*mesh_paths_create)(const struct hp_mesh_solver *solver,
      const struct hp_surface_points *sources, const struct hp_surface_points *ends,
      const struct hp_mesh_options *options, struct hp_paths **paths);
  hp_status (*mesh_paths_through)(const struct hp_mesh_solver *solver,
      const struct hp_surface_points *points, const struct hp_mesh_options *options,
      struct hp_paths **paths);
  hp_status (*mesh_isolines_create)(const struct hp_mesh *mesh, const struct hp_array *values,
      const struct hp_array *levels, struct hp_paths **isolines);
  hp_status (*mesh_curvature)(const struct hp_mesh *mesh, const struct hp_mesh_options *options,
      const struct hp_array *smallest, const struct hp_array *largest,
      const struct hp_array *smallest_directions, const struct hp_array *largest_directions);
  hp_status (*solver_nearest)(const struct hp_solver *solver, const double *sources,
      uint64_t source_count, const struct hp_options *options, const struct hp_buffer *distance,
      const struct hp_buffer *labels, const struct hp_buffer *shares, int64_t share_stride);
  hp_status (*solver_matrix)(const struct hp_solver *solver, const double *from,
      uint64_t from_count, const double *to, uint64_t to_count, const struct hp_options *options,
      const struct hp_array *distances, int64_t row_stride);
  hp_status (*solver_bridge)(const struct hp_solver *solver, const double *from,
      uint64_t from_count, const double *to, uint64_t to_count, const struct hp_options *options,
      const struct hp_buffer *ln_density);
  hp_status (*mesh_locate)(const struct hp_mesh *mesh, const struct hp_surface_points *points,
      const struct hp_array *faces, const struct hp_array *weights,
      const struct hp_array *positions);
  hp_status (*paths_places)(const struct hp_paths *paths, uint64_t index,
      const struct hp_array *faces, const struct hp_array *weights);
  hp_status (*mesh_loop_create)(const struct hp_mesh *mesh, const struct hp_surface_points *points,
      struct hp_paths **loops);
  hp_status (*tube_scales)(const struct hp_buffer *image, const struct hp_buffer *mask,
      const struct hp_options *options, double *scales, uint64_t *count);
};

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* HEATPATH_H */
