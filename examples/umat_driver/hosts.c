/* SPDX-License-Identifier: BSL-1.0 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "host.h"

static double const fence = -8.7654321e300;

static void raise_fence(double* numbers) {
  for (int k = 0; k < 4; ++k) numbers[k] = fence;
}
static int stands(double const* numbers) {
  for (int k = 0; k < 4; ++k) {
    if (numbers[k] != fence) return 0;
  }
  return 1;
}

void host_start(host_point* point, int material, int ntens, int nstatv) {
  memset(point, 0, sizeof *point);
  point->material = material, point->ntens = ntens, point->nstatv = nstatv;
  raise_fence(point->fence0), raise_fence(point->fence1), raise_fence(point->fence2), raise_fence(point->fence3);
  raise_fence(point->fence4);
  size_t const numbers = (size_t)nstatv + 4;
  point->statev = calloc(numbers, sizeof(double));
  point->trial = calloc(numbers, sizeof(double));
  if (!point->statev || !point->trial) abort();
  raise_fence(point->statev + nstatv), raise_fence(point->trial + nstatv);
}

void host_end(host_point* point) {
  free(point->statev);
  free(point->trial);
}

int host_intact(host_point const* point) {
  return stands(point->fence0) && stands(point->fence1) && stands(point->fence2) && stands(point->fence3) &&
         stands(point->fence4) && stands(point->statev + point->nstatv) && stands(point->trial + point->nstatv);
}

/* What every host does before a call: the state and stress of the start. */
static void begin(host_point* point) {
  memcpy(point->trial, point->statev, (size_t)point->nstatv * sizeof(double));
  memcpy(point->stress, point->committed_stress, sizeof point->stress);
  point->pnewdt = 1.0;
}

void abaqus_call(host_point* point, char const* name, double const* dstran) {
  begin(point);
  char cmname[80];
  memset(cmname, ' ', sizeof cmname);
  memcpy(cmname, name, strlen(name));
  double const unit[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}, time[2] = {0.0, 0.0}, zero = 0.0, one = 1.0;
  double const coords[3] = {0.0, 0.0, 0.0};
  double sse = 0.0, spd = 0.0, scd = 0.0, rpl = 0.0, ddsddt[6] = {0.0}, drplde[6] = {0.0}, drpldt = 0.0;
  int const ndi = 3, nshr = point->ntens - 3, none = 0, first = 1, kstep[4] = {1, 0, 0, 0};
  umat_(point->stress, point->trial, point->ddsdde, &sse, &spd, &scd, &rpl, ddsddt, drplde, &drpldt, point->strain,
        dstran, time, &one, &zero, &zero, &zero, &zero, cmname, &ndi, &nshr, &point->ntens, &point->nstatv, &zero,
        &none, coords, unit, &point->pnewdt, &one, unit, unit, &first, &first, &first, &first, kstep, &first);
}

void kratos_call(host_point* point, double const* dstran, int source) {
  begin(point);
  char const name = '?'; /* one letter without an end */
  double const props[3] = {point->material, 1.0, source}, time = 0.0, step = 1.0;
  double sse, spd, scd; /* nothing in them */
  int const ndi = 3, nshr = point->ntens - 3, nprops = 3, none = 0, first = 1;
  umat(point->stress, point->trial, point->ddsdde, &sse, &spd, &scd, NULL, NULL, NULL, NULL, point->strain, dstran,
       &time, &step, NULL, NULL, NULL, NULL, &name, &ndi, &nshr, &point->ntens, &point->nstatv, props, &nprops, NULL,
       NULL, NULL, NULL, NULL, NULL, &none, &none, NULL, NULL, &first, &first);
}

void host_commit(host_point* point, double const* dstran) {
  memcpy(point->statev, point->trial, (size_t)point->nstatv * sizeof(double));
  memcpy(point->committed_stress, point->stress, sizeof point->stress);
  for (int k = 0; k < point->ntens; ++k) point->strain[k] += dstran[k];
}

void strain_of_step(int step, double* strain) {
  double const unit = 1.0 / 16384.0 * (step % 2 == 0 ? 1.0 : 2.0);
  memset(strain, 0, 6 * sizeof(double));
  strain[0] = unit, strain[1] = -4.0 * unit, strain[3] = 3.0 * unit;
}

/* Places of the plane's stresses xx, yy, xy in STRESS of four components, and of six in the orders of Abaqus and
   Kratos. */
int const plane[3] = {0, 1, 3}, short_plane[3] = {0, 1, 2}, abaqus[6] = {0, 1, 2, 5, 4, 3},
          kratos[6] = {0, 1, 2, 4, 5, 3};

double difference(host_point const* point, int const* places, int size, int rows_first, double const* stress,
                  double const* tangent) {
  double worst = 0.0;
  for (int i = 0; i < size; ++i) {
    worst = fmax(worst, apart(&point->stress[places[i]], &stress[i], 1));
    for (int j = 0; j < size; ++j) {
      int const row = rows_first ? places[i] : places[j], column = rows_first ? places[j] : places[i];
      worst = fmax(worst, apart(&point->ddsdde[row * point->ntens + column], &tangent[i * size + j], 1));
    }
  }
  return worst;
}

void reference_strain_step(reference* known, int dim, int ntens, double const* strain, double* stress,
                           double* tangent) {
  double gradient[9];
  reference_gradient(dim, ntens, strain, gradient);
  if (!reference_step(known, gradient, stress, tangent)) check("C++ responds", 0, 0);
}

int whole_state(int material) {
  scarp_material* made = NULL;
  int numbers = 0;
  if (scarp_material_parse(texts[material], &made) || scarp_umat_state_numbers(made, &numbers) ||
      scarp_material_free(made))
    check(scarp_last_error(), 0, 0);
  return numbers + numbers / 5;
}
