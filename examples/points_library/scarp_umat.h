/* SPDX-License-Identifier: BSL-1.0 */
/* The UMAT of libscarp_points: pointers only, by the interface that Abaqus publishes. Conventions: docs/c_and_umat.md.

   umat_ has DDSDDE as Fortran has it, columns first; umat has it as C does, rows first.
   PROPS, all optional: 1 number of the material (0: by CMNAME), 2 order of components (0 Abaqus, 1 Kratos), 3 source of
   the increment (0 DSTRAN and DROT, 1 STRAN + DSTRAN as total strain, 2 DFGRD0 and DFGRD1), 4 height of the ground
   surface [m]. STATEV is zero at first. Wrong input, and a response that is not acceptable where PNEWDT is null, fill
   STRESS and DDSDDE with NaN, so that no host continues in silence; the reason is in scarp_last_error() and on the
   error stream. */
#ifndef SCARP_UMAT_H
#define SCARP_UMAT_H

#include "scarp_points.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SCARP_UMAT_ARGUMENTS                                                                                          \
  double *stress, double *statev, double *ddsdde, double *sse, double *spd, double *scd, double *rpl, double *ddsddt, \
      double *drplde, double *drpldt, double const *stran, double const *dstran, double const *time,                  \
      double const *dtime, double const *temp, double const *dtemp, double const *predef, double const *dpred,        \
      char const *cmname, int const *ndi, int const *nshr, int const *ntens, int const *nstatv, double const *props,  \
      int const *nprops, double const *coords, double const *drot, double *pnewdt, double const *celent,              \
      double const *dfgrd0, double const *dfgrd1, int const *noel, int const *npt, int const *layer, int const *kspt, \
      int const *kstep, int const *kinc

SCARP_POINTS_API void umat_(SCARP_UMAT_ARGUMENTS);
SCARP_POINTS_API void umat(SCARP_UMAT_ARGUMENTS);

/* Length of STATEV that holds a whole state of a material at its start; packings need up to a fifth more later. */
SCARP_POINTS_API int scarp_umat_state_numbers(scarp_material const* material, int* numbers);
/* DEM steps of all calls since the last clear. */
SCARP_POINTS_API int scarp_umat_work(long long* steps);
/* Forgets all materials, snapshots and outcomes, as at the end of an analysis. No call may be under way. */
SCARP_POINTS_API void scarp_umat_clear(void);

#ifdef __cplusplus
}
#endif

#endif
