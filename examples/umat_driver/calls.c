/* SPDX-License-Identifier: BSL-1.0 */
/* Cut-backs, other sources of increments, and calls that are wrong. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "host.h"

static int is_nan(host_point const* point) {
  int all = 1;
  for (int k = 0; k < point->ntens; ++k) all &= point->stress[k] != point->stress[k];
  return all && point->ddsdde[0] != point->ddsdde[0];
}

/* A response that is not acceptable requests a smaller step and changes nothing; half of the step, twice, gives the
   stress of C++. */
void check_cut_back(void) {
  int const room = whole_state(DISCS);
  host_point point;
  host_start(&point, DISCS, 4, room);
  double huge[6] = {0.0, -1.5, 0.0, 0.0}, strain[6], stress[6], tangent[36], worst = 0.0;
  strain_of_step(0, strain);
  reference* known = reference_new(DISCS);
  for (int half = 0; half < 2; ++half) {
    abaqus_call(&point, "DISCS", huge);
    int good = point.pnewdt == 0.5 && memcmp(point.stress, point.committed_stress, sizeof point.stress) == 0;
    good = good && memcmp(point.trial, point.statev, (size_t)room * sizeof(double)) == 0 && point.ddsdde[0] > 1e5;
    check("a step that is too large: PNEWDT", point.pnewdt, good);
    kratos_call(&point, huge, 0);
    check("without PNEWDT its stress is no number", 0, is_nan(&point) && reports("PNEWDT is null"));
    abaqus_call(&point, "DISCS", strain);
    reference_strain_step(known, 2, 4, strain, stress, tangent);
    worst = fmax(worst, difference(&point, plane, 3, 0, stress, tangent));
    host_commit(&point, strain);
  }
  check("two steps after cut-backs [Pa]", worst, worst == 0.0 && host_intact(&point));
  reference_free(known);
  host_end(&point);
}

/* DFGRD0 and DFGRD1 without NDI, NSHR and all else that may be null. */
void check_deformation(void) {
  double const props[3] = {DISCS, 0.0, 2.0}, before[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  double const u = 1.0 / 8192.0, gradient[4] = {-u, 2.0 * u, 0.0, -u};
  double const after[9] = {1.0 - u, 0.0, 0.0, 2.0 * u, 1.0 - u, 0.0, 0.0, 0.0, 1.0}; /* columns first */
  double stress[6], tangent[36], found[4], ddsdde[16], statev[4] = {0.0};
  int const four = 4, three = 3;
  umat_(found, statev, ddsdde, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL,
        NULL, NULL, NULL, &four, &four, props, &three, NULL, NULL, NULL, NULL, before, after, NULL, NULL, NULL, NULL,
        NULL, NULL);
  reference* known = reference_new(DISCS);
  reference_step(known, gradient, stress, tangent);
  found[2] = found[3];
  double const worst = apart(found, stress, 3);
  check("by deformation gradients, rotation included, all else null [Pa]", worst, worst == 0.0);
  reference_free(known);
}

/* DROT turns the stress of the step before: R s R^T, with R by columns. */
void check_rotation(void) {
  double const props[1] = {ELASTIC}, angle = 0.5, c = cos(angle), s = sin(angle);
  double const turn[9] = {c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0};
  double strain[6] = {1e-4, -4e-4, 3e-4}, before[3], found[3], ddsdde[9], statev[100] = {0.0};
  double const still[3] = {0.0};
  int const three = 3, hundred = 100, one = 1;
  umat_(before, statev, ddsdde, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, strain, NULL, NULL, NULL, NULL, NULL,
        NULL, NULL, NULL, NULL, &three, &hundred, props, &one, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL,
        NULL, NULL, NULL);
  umat_(found, statev, ddsdde, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, still, NULL, NULL, NULL, NULL, NULL,
        NULL, NULL, NULL, NULL, &three, &hundred, props, &one, NULL, turn, NULL, NULL, NULL, NULL, NULL, NULL, NULL,
        NULL, NULL, NULL);
  double const known[3] = {c * c * before[0] + s * s * before[1] - 2.0 * c * s * before[2],
                           s * s * before[0] + c * c * before[1] + 2.0 * c * s * before[2],
                           c * s * (before[0] - before[1]) + (c * c - s * s) * before[2]};
  double const worst = apart(found, known, 3);
  /* Round-off of stresses up to 1e4 Pa. */
  check("DROT turns the stress, within 1e-10", worst, worst < 1e-10 && fabs(before[2]) > 1e3);
  double stretched[9];
  for (int k = 0; k < 9; ++k) stretched[k] = 1.01 * turn[k];
  umat_(found, statev, ddsdde, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, still, NULL, NULL, NULL, NULL, NULL,
        NULL, NULL, NULL, NULL, &three, &hundred, props, &one, NULL, stretched, NULL, NULL, NULL, NULL, NULL, NULL,
        NULL, NULL, NULL, NULL);
  check("a DROT that stretches is rejected with a reason", 1.0, found[0] != found[0] && reports("DROT is no rotation"));
  double const mirror[9] = {-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  umat_(found, statev, ddsdde, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, still, NULL, NULL, NULL, NULL, NULL,
        NULL, NULL, NULL, NULL, &three, &hundred, props, &one, NULL, mirror, NULL, NULL, NULL, NULL, NULL, NULL, NULL,
        NULL, NULL, NULL);
  check("a DROT that reflects is rejected with a reason", 1.0, found[0] != found[0] && reports("DROT is a reflection"));
  /* With increments from STRAN, which the host has turned. */
  double const by_total[3] = {ELASTIC, 0.0, 1.0}, xx = strain[0], yy = strain[1], xy = strain[2] / 2.0;
  double const turned[3] = {c * c * xx + s * s * yy - 2.0 * c * s * xy, s * s * xx + c * c * yy + 2.0 * c * s * xy,
                            2.0 * (c * s * (xx - yy) + (c * c - s * s) * xy)};
  double fresh[100] = {0.0};
  umat_(found, fresh, ddsdde, NULL, NULL, NULL, NULL, NULL, NULL, NULL, still, strain, NULL, NULL, NULL, NULL, NULL,
        NULL, NULL, NULL, NULL, &three, &hundred, by_total, &three, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL,
        NULL, NULL, NULL, NULL);
  umat_(found, fresh, ddsdde, NULL, NULL, NULL, NULL, NULL, NULL, NULL, turned, still, NULL, NULL, NULL, NULL, NULL,
        NULL, NULL, NULL, NULL, &three, &hundred, by_total, &three, NULL, turn, NULL, NULL, NULL, NULL, NULL, NULL,
        NULL, NULL, NULL, NULL);
  double const off = apart(found, known, 3);
  check("so it does with increments from STRAN, within 1e-8", off, off < 1e-8);
  double const level[4] = {ELASTIC, 0.0, 0.0, 0.0}, coords[3] = {0.0, 5.0, 0.0};
  double above[100] = {0.0};
  int const four = 4;
  umat_(found, above, ddsdde, NULL, NULL, NULL, NULL, NULL, NULL, NULL, still, strain, NULL, NULL, NULL, NULL, NULL,
        NULL, NULL, NULL, NULL, &three, &hundred, level, &four, coords, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL,
        NULL, NULL, NULL);
  check("a point above the surface is rejected with a reason", 5.0, found[0] != found[0] && reports("5 m above"));
}

/* A material in space as plane strain, y vertical: the stresses of the plane, and the stress out of it. */
void check_plane_in_space(void) {
  host_point point;
  host_start(&point, ELASTIC_IN_SPACE, 4, 200);
  double strain[6], stress[6], tangent[36];
  strain_of_step(1, strain);
  abaqus_call(&point, "ROCK", strain);
  reference* known = reference_new(ELASTIC);
  reference_strain_step(known, 2, 4, strain, stress, tangent);
  double const worst = difference(&point, plane, 3, 0, stress, tangent);
  double const across = fabs(point.stress[2] - 0.3 * (stress[0] + stress[1])); /* nu (s11 + s22) */
  /* Round-off of numbers up to 3e7 Pa, whose sums have another order. */
  check("elastic in space with NTENS of 4, against the plane, within 1e-7", fmax(worst, across),
        worst < 1e-7 && across < 1e-7);
  reference_free(known);
  host_end(&point);
}

void check_wrong_calls(void) {
  double strain[6], statev = 0.0;
  strain_of_step(0, strain);
  host_point point;
  host_start(&point, DISCS, 4, 3);
  abaqus_call(&point, "DISCS", strain);
  check("a STATEV of 3 numbers is rejected with a reason", 3,
        is_nan(&point) && reports("STATEV has 3 numbers") && host_intact(&point));
  host_end(&point);

  host_start(&point, DISCS, 6, 4);
  abaqus_call(&point, "DISCS", strain);
  check("NTENS of 6 for a plane material is rejected with a reason", 6, is_nan(&point) && reports("NTENS is 6"));
  host_end(&point);

  host_start(&point, DISCS, 4, whole_state(DISCS));
  abaqus_call(&point, "NOWHERE", strain);
  int good = is_nan(&point) && reports("nowhere.txt");
  abaqus_call(&point, "DISCS", strain);
  host_commit(&point, strain);
  double const kept = point.statev[100];
  point.statev[100] = kept + 1.0;
  abaqus_call(&point, "DISCS", strain);
  good &= is_nan(&point) && reports("STATEV was changed");
  point.statev[100] = NAN;
  abaqus_call(&point, "DISCS", strain);
  good &= is_nan(&point) && reports("STATEV(101)");
  point.statev[100] = kept;
  double* const whole = malloc((size_t)point.nstatv * sizeof(double));
  if (!whole) abort();
  memcpy(whole, point.statev, (size_t)point.nstatv * sizeof(double));
  for (int k = 4; k < point.nstatv; ++k) point.statev[k] = (double)(float)whole[k];
  abaqus_call(&point, "DISCS", strain);
  good &= is_nan(&point) && reports("double precision");
  memcpy(point.statev, whole, (size_t)point.nstatv * sizeof(double));
  free(whole);
  strain[2] = 1e-3;
  abaqus_call(&point, "DISCS", strain);
  good &= is_nan(&point) && reports("out of the plane");
  strain[2] = NAN;
  abaqus_call(&point, "DISCS", strain);
  good &= is_nan(&point) && reports("not finite") && host_intact(&point);
  check("an unknown material, a changed STATEV and NaN are rejected with a reason", 6, good);
  host_end(&point);

  umat_(NULL, &statev, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL,
        NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL,
        NULL);
  check("a call with null for all is rejected with a reason", 0, reports("STRESS is null"));
}
