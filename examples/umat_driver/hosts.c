/* SPDX-License-Identifier: BSL-1.0 */
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
