/* SPDX-License-Identifier: BSL-1.0 */
/* Do C++, C and a UMAT give the same bits? Sequences of calls of Abaqus and of Kratos, two materials, two threads, wrong input. */
#define _POSIX_C_SOURCE 200809L
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <threads.h>
#include <unistd.h>

#include "host.h"

static int wrong = 0;
static char const* const names[MATERIALS + 1] = {"", "ELASTIC", "SOIL", "DISCS", "ROCK"};
static char const* const texts[MATERIALS + 1] = {
    "", "kind elastic\nyoung 20e6\npoisson 0.3\n",
    "kind mohr-coulomb\nyoung 20e6\npoisson 0.3\ncohesion 1e3\nfriction 30\ndilation 5\nsurcharge 1e5\n",
    "kind packing\nshape disc # of 4 to 6 mm\ngrains 100\npressure 1e5\n",
    "kind elastic\ndimension 3\nyoung 20e6\npoisson 0.3\n"};

void check(char const* what, double figure, int good) {
  printf("%-72s %12.5g  %s\n", what, figure, good ? "ok" : "WRONG");
  wrong += !good;
}
int said(char const* words) { return strstr(scarp_last_error(), words) != NULL; }
double apart(double const* a, double const* b, int count) {
  double worst = 0.0;
  for (int k = 0; k < count; ++k) worst = fabs(a[k] - b[k]) <= worst ? worst : fabs(a[k] - b[k]);
  return worst;
}

static void write_file(char const* path, char const* text) {
  FILE* file = fopen(path, "w");
  if (!file || fputs(text, file) < 0 || fclose(file) != 0) abort();
}

/* By number and by the name of CMNAME in small letters. */
static void write_materials(void) {
  for (int k = 1; k <= MATERIALS; ++k) {
    char path[32];
    snprintf(path, sizeof path, "material_%d.txt", k);
    write_file(path, texts[k]);
    snprintf(path, sizeof path, "%s.txt", names[k]);
    for (char* letter = path; *letter; ++letter) *letter = (char)tolower(*letter);
    write_file(path, texts[k]);
  }
}

/* Increment of strain of a step: 11, 22, 33, 12. */
static void strain_of_step(int step, double* strain) {
  double const unit = 1.0 / 16384.0 * (step % 2 == 0 ? 1.0 : 2.0);
  memset(strain, 0, 6 * sizeof(double));
  strain[0] = unit, strain[1] = -4.0 * unit, strain[3] = 3.0 * unit;
}

/* Places of the plane's stresses xx, yy, xy in STRESS of four components, and of six in the orders of Abaqus and Kratos. */
static int const plane[3] = {0, 1, 3}, short_plane[3] = {0, 1, 2}, abaqus[6] = {0, 1, 2, 5, 4, 3},
                 kratos[6] = {0, 1, 2, 4, 5, 3};

/* Largest difference of STRESS and DDSDDE of a host from a stress and tangent of C++. */
static double difference(host_point const* point, int const* places, int size, int rows_first, double const* stress,
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

static void reference_strain_step(reference* known, int dim, int ntens, double const* strain, double* stress,
                                  double* tangent) {
  double gradient[9];
  reference_gradient(dim, ntens, strain, gradient);
  if (!reference_step(known, gradient, stress, tangent)) check("C++ responds", 0, 0);
}

/* Abaqus: iterations try other increments from the committed state; a step of twice the size is cut back to two of the size. */
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
  reference_free(known);
  host_end(&point);
  return worst;
}

/* Kratos: a call without increment at the start whose state is not kept; then each response twice, for stress and for tangent. */
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
  reference_free(known);
  host_end(&point);
  return worst;
}

static int whole_state(int material) {
  scarp_material* made = NULL;
  int numbers = 0;
  if (scarp_material_parse(texts[material], &made) || scarp_umat_state_numbers(made, &numbers) ||
      scarp_material_free(made))
    check(scarp_last_error(), 0, 0);
  return numbers + numbers / 5;
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

static void check_sequences(void) {
  int good = 1;
  int const room = whole_state(DISCS);
  double worst = abaqus_path(DISCS, 4, room, &good);
  check("Abaqus, packing, whole state in STATEV [Pa]", worst, good && worst == 0.0);
  worst = abaqus_path(DISCS, 4, 4, &good);
  check("Abaqus, packing, key in a STATEV of 4 [Pa]", worst, good && worst == 0.0);
  worst = abaqus_path(MOHR_COULOMB, 3, whole_state(MOHR_COULOMB), &good);
  check("Abaqus, Mohr-Coulomb, three components [Pa]", worst, good && worst == 0.0);
  worst = abaqus_path(MOHR_COULOMB, 4, whole_state(MOHR_COULOMB), &good);
  check("Abaqus, Mohr-Coulomb [Pa]", worst, good && worst == 0.0);
  worst = abaqus_path(ELASTIC_IN_SPACE, 6, 200, &good);
  check("Abaqus, elastic in space [Pa]", worst, good && worst == 0.0);
  worst = kratos_path(ELASTIC_IN_SPACE, 6, 4, 0, &good);
  check("Kratos, elastic in space, null pointers [Pa]", worst, good && worst == 0.0);
  worst = kratos_path(DISCS, 4, 4, 0, &good);
  check("Kratos, packing, each response twice [Pa]", worst, good && worst == 0.0);
  worst = kratos_path(DISCS, 4, room, 1, &good);
  check("Kratos, packing, by total strain [Pa]", worst, good && worst == 0.0);

  task tasks[2] = {{.material = DISCS}, {.material = MOHR_COULOMB}};
  thrd_t threads[2];
  for (int k = 0; k < 2; ++k) thrd_create(&threads[k], run_task, &tasks[k]);
  for (int k = 0; k < 2; ++k) thrd_join(threads[k], NULL);
  worst = fmax(tasks[0].worst, tasks[1].worst);
  check("two materials on two threads at once [Pa]", worst, tasks[0].good && tasks[1].good && worst == 0.0);
}

static int is_nan(host_point const* point) {
  int all = 1;
  for (int k = 0; k < point->ntens; ++k) all &= point->stress[k] != point->stress[k];
  return all && point->ddsdde[0] != point->ddsdde[0];
}

/* A response that is not acceptable asks for a smaller step and changes nothing; half of the step, twice, is what C++ finds. */
static void check_cut_back(void) {
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
    check("without PNEWDT its stress is no number", 0, is_nan(&point) && said("PNEWDT is null"));
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
static void check_deformation(void) {
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
  double const worst = fmax(fabs(found[0] - stress[0]), fmax(fabs(found[1] - stress[1]), fabs(found[3] - stress[2])));
  check("by deformation gradients, rotation included, all else null [Pa]", worst, worst == 0.0);
  reference_free(known);
}

static void check_wrong_calls(void) {
  double strain[6], statev = 0.0;
  strain_of_step(0, strain);
  host_point point;
  host_start(&point, DISCS, 4, 3);
  abaqus_call(&point, "DISCS", strain);
  check("a STATEV of 3 numbers is refused in words", 3,
        is_nan(&point) && said("STATEV has 3 numbers") && host_intact(&point));
  host_end(&point);

  host_start(&point, DISCS, 6, 4);
  abaqus_call(&point, "DISCS", strain);
  check("NTENS of 6 for a plane material is refused in words", 6, is_nan(&point) && said("NTENS is 6"));
  host_end(&point);

  host_start(&point, DISCS, 4, whole_state(DISCS));
  abaqus_call(&point, "NOWHERE", strain);
  int good = is_nan(&point) && said("nowhere.txt");
  abaqus_call(&point, "DISCS", strain);
  host_commit(&point, strain);
  double const kept = point.statev[100];
  point.statev[100] = kept + 1.0;
  abaqus_call(&point, "DISCS", strain);
  good &= is_nan(&point) && said("STATEV was changed");
  point.statev[100] = NAN;
  abaqus_call(&point, "DISCS", strain);
  good &= is_nan(&point) && said("STATEV(101)");
  point.statev[100] = kept;
  strain[2] = 1e-3;
  abaqus_call(&point, "DISCS", strain);
  good &= is_nan(&point) && said("out of the plane");
  strain[2] = NAN;
  abaqus_call(&point, "DISCS", strain);
  good &= is_nan(&point) && said("not finite") && host_intact(&point);
  check("an unknown material, a changed STATEV and NaN are refused in words", 5, good);
  host_end(&point);

  umat_(NULL, &statev, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL,
        NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL,
        NULL);
  check("a call with null for all is refused in words", 0, said("STRESS is null"));
}

int main(void) {
  char folder[] = "/tmp/umat_driver_XXXXXX";
  if (!mkdtemp(folder) || chdir(folder) != 0) return 2;
  write_materials();
  check_c_functions();
  check_wrong_input();
  check_sequences();
  check_cut_back();
  check_deformation();
  check_wrong_calls();
  scarp_umat_clear();
  printf("%d wrong\n", wrong);
  return wrong == 0 ? 0 : 1;
}
