/* SPDX-License-Identifier: BSL-1.0 */
/* The order in which Abaqus and Kratos call. */
#include <math.h>
#include <string.h>
#include <threads.h>

#include "host.h"

/* Flow that is not associated: the order of rows and columns counts. */
static int is_plastic(double const* tangent) { return fabs(tangent[1] - tangent[3]) > 1e5; }

/* Abaqus: iterations try other increments from the committed state, the first of twice the size, before the last one
   is kept. */
static double abaqus_path(int material, int ntens, int nstatv, int* good) {
  int const dim = ntens == 6 ? 3 : 2;
  int const* const places = ntens == 3 ? short_plane : ntens == 4 ? plane : abaqus;
  host_point point;
  host_start(&point, material, ntens, nstatv);
  reference* known = reference_new(material);
  double worst = 0.0, strain[6], other[6], stress[6], tangent[36];
  for (int step = 0; step < 6; ++step) {
    strain_of_step(step, strain);
    if (ntens == 3) strain[2] = strain[3];
    for (int iteration = 0; iteration < 7; ++iteration) { /* more than snapshots are kept */
      for (int k = 0; k < 6; ++k) other[k] = strain[k] * (2.0 - 0.25 * iteration);
      abaqus_call(&point, names[material], other);
    }
    abaqus_call(&point, names[material], strain);
    reference_strain_step(known, dim, ntens, strain, stress, tangent);
    worst = fmax(worst, difference(&point, places, dim == 2 ? 3 : 6, 0, stress, tangent));
    *good &= host_intact(&point) && point.pnewdt == 1.0;
    host_commit(&point, strain);
  }
  *good &= material != MOHR_COULOMB || is_plastic(tangent);
  reference_free(known);
  host_end(&point);
  return worst;
}

/* Kratos: a call without increment at the start whose state is not kept; then each response twice, for stress and for
   tangent. */
static double kratos_path(int material, int ntens, int nstatv, int source, int* good) {
  int const dim = ntens == 6 ? 3 : 2;
  host_point point;
  host_start(&point, material, ntens, nstatv);
  reference* known = reference_new(material);
  double worst = 0.0, strain[6] = {0.0}, stress[6], tangent[36], statev[4];
  kratos_call(&point, strain, source);
  for (int step = 0; step < 4; ++step) {
    strain_of_step(step, strain);
    kratos_call(&point, strain, source);
    memcpy(statev, point.trial, sizeof statev);
    memset(point.ddsdde, 0, sizeof point.ddsdde);
    kratos_call(&point, strain, source);
    /* The second call finds the state of the first one; without memory it would have another generation. */
    *good &= step == 0 || memcmp(statev, point.trial, sizeof statev) == 0;
    reference_strain_step(known, dim, ntens, strain, stress, tangent);
    worst = fmax(worst, difference(&point, dim == 2 ? plane : kratos, dim == 2 ? 3 : 6, 1, stress, tangent));
    *good &= host_intact(&point);
    host_commit(&point, strain);
  }
  *good &= material != MOHR_COULOMB || is_plastic(tangent);
  reference_free(known);
  host_end(&point);
  return worst;
}

static int work_is(long long expected) {
  long long steps = -1;
  return scarp_umat_work(&steps) == SCARP_DONE && steps == expected;
}

/* Neither increments of zero, of a new point and of a committed state, nor repeated requests take DEM steps. */
static void check_work(void) {
  scarp_umat_clear();
  host_point point;
  host_start(&point, DISCS, 4, whole_state(DISCS));
  double strain[6], still[6] = {0.0};
  strain_of_step(0, strain);
  kratos_call(&point, still, 0);
  int good = work_is(0);
  long long steps = 0;
  kratos_call(&point, strain, 0);
  good &= scarp_umat_work(&steps) == SCARP_DONE && steps > 0;
  kratos_call(&point, strain, 0);
  good &= work_is(steps);
  host_commit(&point, strain);
  kratos_call(&point, still, 0);
  good &= work_is(steps);
  check("DEM steps of an increment; none of a repetition, none of zero", (double)steps, good);
  host_end(&point);
}

typedef struct {
  int material, good;
  double worst;
} task;
static int run_task(void* argument) {
  task* const own = argument;
  own->good = 1;
  own->worst = abaqus_path(own->material, 4, 4, &own->good);
  return 0;
}

static void same_bits(char const* what, double worst, int* good) {
  check(what, worst, *good && worst == 0.0);
  *good = 1;
}

void check_sequences(void) {
  int good = 1;
  int const room = whole_state(DISCS);
  double worst = abaqus_path(DISCS, 4, room, &good);
  same_bits("Abaqus, packing, whole state in STATEV [Pa]", worst, &good);
  worst = abaqus_path(DISCS, 4, 4, &good);
  same_bits("Abaqus, packing, key in a STATEV of 4 [Pa]", worst, &good);
  worst = abaqus_path(MOHR_COULOMB, 3, whole_state(MOHR_COULOMB), &good);
  same_bits("Abaqus, Mohr-Coulomb, three components [Pa]", worst, &good);
  worst = abaqus_path(MOHR_COULOMB, 4, whole_state(MOHR_COULOMB), &good);
  same_bits("Abaqus, Mohr-Coulomb [Pa]", worst, &good);
  worst = abaqus_path(ELASTIC_IN_SPACE, 6, 200, &good);
  same_bits("Abaqus, elastic in space [Pa]", worst, &good);
  worst = kratos_path(ELASTIC_IN_SPACE, 6, 4, 0, &good);
  same_bits("Kratos, elastic in space, null pointers [Pa]", worst, &good);
  worst = kratos_path(MOHR_COULOMB, 4, 4, 0, &good);
  same_bits("Kratos, Mohr-Coulomb, tangent that is not symmetric [Pa]", worst, &good);
  worst = kratos_path(DISCS, 4, 4, 0, &good);
  same_bits("Kratos, packing, each response twice [Pa]", worst, &good);
  worst = kratos_path(DISCS, 4, room, 1, &good);
  same_bits("Kratos, packing, by total strain [Pa]", worst, &good);
  check_work();

  task tasks[3] = {{.material = DISCS}, {.material = MOHR_COULOMB}, {.material = DISCS}};
  thrd_t threads[3];
  for (int k = 0; k < 3; ++k) thrd_create(&threads[k], run_task, &tasks[k]);
  worst = 0.0;
  for (int k = 0; k < 3; ++k) {
    thrd_join(threads[k], NULL);
    worst = fmax(worst, tasks[k].worst);
    good &= tasks[k].good;
  }
  same_bits("two materials, one of them twice, on three threads at once [Pa]", worst, &good);
}
