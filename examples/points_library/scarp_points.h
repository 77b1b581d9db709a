/* SPDX-License-Identifier: BSL-1.0 */
/* Material points of scarp for programs in C, Fortran and all that call C.

   A material is read from text (materials.hpp lists the keys); a batch has points of one material. Handles are freed by
   their own function; a freed one is rejected, never followed. Functions return a scarp_status; after anything but
   SCARP_DONE scarp_last_error() returns what is wrong and what to do. A batch may be used by several threads, one after
   the other.

   Plane (dimension 2): gradients xx, xy, yx, yy; stresses xx, yy, xy. Space (3): gradients of nine numbers, rows first;
   stresses xx, yy, zz, yz, zx, xy. Tangents: rows first, stress by strain with engineering shear. Tension is positive.
   [Pa] */
#ifndef SCARP_POINTS_H
#define SCARP_POINTS_H

#include <stddef.h>

#if defined(__GNUC__)
#define SCARP_POINTS_API __attribute__((visibility("default")))
#else
#define SCARP_POINTS_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef struct scarp_material scarp_material;
typedef struct scarp_points scarp_points;

typedef enum {
  SCARP_DONE = 0,
  SCARP_NOT_ACCEPTABLE = 1, /* of respond: a point's response must not be committed; set another increment */
  SCARP_WRONG_INPUT = 2,
  SCARP_FILE_ERROR = 3,
  SCARP_FAILURE = 4 /* memory, threads, a packing that cannot be prepared */
} scarp_status;

/* A point's response: number of its status (ok 0, fluid 1, not_converged 2, failed 3), of the reason, both as text. */
typedef struct {
  int status;
  int reason;
  char const* status_name;
  char const* reason_name;
  int point; /* the worst one of a batch, -1 where all are acceptable */
} scarp_verdict;

/* Of the calling thread's last function that did not return SCARP_DONE; stays until the next such one. Never null. */
SCARP_POINTS_API char const* scarp_last_error(void);

SCARP_POINTS_API int scarp_material_read(char const* path, scarp_material** material);
SCARP_POINTS_API int scarp_material_parse(char const* text, scarp_material** material);
SCARP_POINTS_API int scarp_material_dimension(scarp_material const* material, int* dimension);
SCARP_POINTS_API int scarp_material_free(scarp_material* material);

/* depths [m] of the points below the ground surface, or NULL: zero. The material may be freed afterwards. */
SCARP_POINTS_API int scarp_points_create(scarp_material const* material, int count, double const* depths,
                                         scarp_points** points);
SCARP_POINTS_API int scarp_points_free(scarp_points* points);
SCARP_POINTS_API int scarp_points_count(scarp_points const* points, int* count);

/* Displacement gradients since the last commit, of all points; numbers: how many there are, checked. */
SCARP_POINTS_API int scarp_points_set_gradients(scarp_points* points, double const* gradients, size_t numbers);
/* threads: 0 takes all cores; the result has the same bits for any number. worst may be NULL. */
SCARP_POINTS_API int scarp_points_respond(scarp_points* points, int threads, scarp_verdict* worst);
SCARP_POINTS_API int scarp_points_verdict(scarp_points const* points, int point, scarp_verdict* verdict);
/* Of the last responses. */
SCARP_POINTS_API int scarp_points_stresses(scarp_points const* points, double* stresses, size_t numbers);
SCARP_POINTS_API int scarp_points_tangents(scarp_points const* points, double* tangents, size_t numbers);
/* Of the committed states. */
SCARP_POINTS_API int scarp_points_committed_stresses(scarp_points const* points, double* stresses, size_t numbers);
SCARP_POINTS_API int scarp_points_committed_tangents(scarp_points const* points, double* tangents, size_t numbers);

/* Only after responses that are acceptable. */
SCARP_POINTS_API int scarp_points_commit(scarp_points* points);
SCARP_POINTS_API int scarp_points_discard(scarp_points* points);

/* Bytes of a point's committed state. bytes NULL: only the length is returned; too little room is rejected. */
SCARP_POINTS_API int scarp_points_pack(scarp_points const* points, int point, void* bytes, size_t room, size_t* length);
SCARP_POINTS_API int scarp_points_unpack(scarp_points* points, int point, void const* bytes, size_t length);
/* All committed states. */
SCARP_POINTS_API int scarp_points_save(scarp_points const* points, char const* path);
SCARP_POINTS_API int scarp_points_load(scarp_points* points, char const* path);

/* A number of a committed state: of packings void_ratio, coordination, unbalanced_ratio and others. */
SCARP_POINTS_API int scarp_points_quantity(scarp_points const* points, int point, char const* name, double* value);
/* DEM steps of a point's last response. */
SCARP_POINTS_API int scarp_points_work(scarp_points const* points, int point, long long* steps);

#ifdef __cplusplus
}
#endif

#endif
