/* SPDX-License-Identifier: BSL-1.0 */
/* The functions of scarp_points.h: the bits of C++, states that come back, and wrong input. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "host.h"

static scarp_points* points_of(int material, int count) {
  char path[32];
  snprintf(path, sizeof path, "material_%d.txt", material);
  scarp_material* read = NULL;
  scarp_points* points = NULL;
  if (scarp_material_read(path, &read) || scarp_points_create(read, count, NULL, &points) ||
      scarp_material_free(read)) {
    fprintf(stderr, "error: %s\n", scarp_last_error());
    exit(1);
  }
  return points;
}

/* Increment of a step, exact in binary: shear, compression and some rotation. */
static void gradient_of_step(int dim, int step, double* gradient) {
  double const unit = 1.0 / 16384.0 * (step % 2 == 0 ? 1.0 : 2.0);
  memset(gradient, 0, 9 * sizeof(double));
  gradient[0] = unit, gradient[1] = 2.0 * unit, gradient[dim] = unit, gradient[dim + 1] = -4.0 * unit;
}

static void compare(int material, int dim, char const* what) {
  int const count = 3, size = dim == 2 ? 3 : 6, square = size * size;
  scarp_points* points = points_of(material, count);
  reference* known = reference_new(material);
  double worst = 0.0, one[9], gradients[27], stress[6], tangent[36], stresses[18], tangents[108];
  int good = 1;
  for (int step = 0; step < 4; ++step) {
    gradient_of_step(dim, step, one);
    for (int k = 0; k < count; ++k) memcpy(gradients + k * dim * dim, one, (size_t)(dim * dim) * sizeof(double));
    good &= scarp_points_set_gradients(points, gradients, (size_t)(count * dim * dim)) == SCARP_DONE;
    good &= scarp_points_respond(points, 2, NULL) == SCARP_DONE;
    good &= scarp_points_stresses(points, stresses, (size_t)(count * size)) == SCARP_DONE;
    good &= scarp_points_tangents(points, tangents, (size_t)(count * square)) == SCARP_DONE;
    good &= scarp_points_commit(points) == SCARP_DONE && reference_step(known, one, stress, tangent);
    for (int k = 0; k < count; ++k) {
      worst = fmax(worst, apart(stresses + k * size, stress, size));
      worst = fmax(worst, apart(tangents + k * square, tangent, square));
    }
  }
  check(what, worst, good && worst == 0.0);
  reference_free(known);
  scarp_points_free(points);
}

/* Packed by one batch and unpacked by another, saved and loaded: the next response has the same bits. */
static void states_come_back(void) {
  scarp_points *first = points_of(DISCS, 1), *second = points_of(DISCS, 1), *third = points_of(DISCS, 1);
  double gradient[9], stress[3], other[3];
  gradient_of_step(2, 0, gradient);
  int good = scarp_points_set_gradients(first, gradient, 4) == SCARP_DONE;
  good &= scarp_points_respond(first, 1, NULL) == SCARP_DONE && scarp_points_commit(first) == SCARP_DONE;
  size_t length = 0, again = 0;
  good &= scarp_points_pack(first, 0, NULL, 0, &length) == SCARP_DONE && length > 1000;
  char* bytes = malloc(length + 8);
  if (!bytes) abort();
  memset(bytes, 7, length + 8);
  good &= scarp_points_pack(first, 0, bytes, length - 1, &again) == SCARP_WRONG_INPUT && reports("give more");
  good &= scarp_points_pack(first, 0, bytes, length, &again) == SCARP_DONE && bytes[length] == 7;
  good &= scarp_points_unpack(second, 0, bytes, length) == SCARP_DONE;
  good &=
      scarp_points_save(first, "points.scarp") == SCARP_DONE && scarp_points_load(third, "points.scarp") == SCARP_DONE;
  good &= scarp_points_unpack(second, 0, bytes, length / 2) == SCARP_WRONG_INPUT && reports("save it again");
  scarp_points* two = points_of(DISCS, 2);
  good &=
      scarp_points_load(two, "points.scarp") == SCARP_WRONG_INPUT && reports("1 points in 2 dimensions (there are 2");
  good &= scarp_points_save(two, NULL) == SCARP_WRONG_INPUT && scarp_points_load(two, NULL) == SCARP_WRONG_INPUT;
  good &= scarp_points_save(two, "no/folder") == SCARP_FILE_ERROR && scarp_points_free(two) == SCARP_DONE;
  scarp_points* const all[3] = {first, second, third};
  double worst = 0.0;
  for (int k = 0; k < 3; ++k) {
    good &= scarp_points_set_gradients(all[k], gradient, 4) == SCARP_DONE;
    good &= scarp_points_respond(all[k], 1, NULL) == SCARP_DONE;
    good &= scarp_points_stresses(all[k], k == 0 ? stress : other, 3) == SCARP_DONE;
    if (k > 0) worst = fmax(worst, apart(stress, other, 3));
  }
  check("a packing packed, and saved in a file, resumes with the same bits", worst, good && worst == 0.0);
  double ratio = 0.0;
  long long steps = 0;
  good = scarp_points_quantity(first, 0, "void_ratio", &ratio) == SCARP_DONE && ratio > 0.1 && ratio < 0.4;
  good &= scarp_points_quantity(first, 0, "mood", &ratio) == SCARP_WRONG_INPUT && reports("void_ratio");
  good &= scarp_points_work(first, 0, &steps) == SCARP_DONE && steps >= 20;
  check("DEM steps of its last response, void ratio by name", (double)steps, good);
  free(bytes);
  for (int k = 0; k < 3; ++k) scarp_points_free(all[k]);
}

/* Points of three threads respond, are freed and end in a process that was forked, which has none of these. */
static void forked(void) {
  scarp_points* points = points_of(ELASTIC, 4);
  double gradients[16] = {0.0}, stresses[12], others[12];
  gradients[3] = gradients[7] = -1.0 / 4096.0;
  int good = scarp_points_set_gradients(points, gradients, 16) == SCARP_DONE;
  good &= scarp_points_respond(points, 3, NULL) == SCARP_DONE;
  good &= scarp_points_stresses(points, stresses, 12) == SCARP_DONE;
  pid_t const child = fork();
  if (child == 0) {
    alarm(20);
    good &= scarp_points_respond(points, 3, NULL) == SCARP_DONE;
    good &= scarp_points_stresses(points, others, 12) == SCARP_DONE && apart(stresses, others, 12) == 0.0;
    _exit(good && scarp_points_free(points) == SCARP_DONE ? 7 : 1);
  }
  int status = 0;
  good &= waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 7;
  check("C: points of three threads in a forked process", status, good);
  scarp_points_free(points);
}

void check_c_functions(void) {
  compare(ELASTIC, 2, "C: elastic in the plane, 3 points, 4 steps [Pa]");
  compare(ELASTIC_IN_SPACE, 3, "C: elastic in space [Pa]");
  compare(MOHR_COULOMB, 2, "C: Mohr-Coulomb [Pa]");
  compare(DISCS, 2, "C: packings of discs, 2 threads [Pa]");
  states_come_back();
  forked();
}

static int rejected(int status, char const* text) { return status == SCARP_WRONG_INPUT && reports(text); }

void check_wrong_input(void) {
  scarp_material* material = NULL;
  scarp_points* points = points_of(ELASTIC, 2);
  double numbers[18] = {0.0}, few[4] = {0.0};
  int good = rejected(scarp_material_parse("kind elastic\nyoung 1e6\npoison 0.3\n", &material), "'poison'");
  good &= rejected(scarp_material_parse("kind elastic\nyoung -1\n", &material), "Young's modulus is -1");
  good &= rejected(scarp_material_parse("kind elastic\nyoung ten\n", &material), "'ten'") && material == NULL;
  good &= rejected(scarp_material_parse(NULL, &material), "null") && rejected(scarp_material_parse("", NULL), "null");
  good &= rejected(scarp_material_read("nowhere.txt", &material), "no such file");
  good &=
      rejected(scarp_material_parse("kind packing\nfile material_1.txt\n", &material), "or give shape, law, friction");
  good &= rejected(scarp_material_parse("kind packing\nsmallest 2\nlargest 1\n", &material), "largest size");
  good &= rejected(scarp_material_parse("kind packing\naspect 0.5\n", &material), "'aspect'");
  good &= rejected(scarp_material_parse("kind packing\nrolling-friction 0.5\n", &material), "'rolling-friction'");
  good &= rejected(scarp_material_parse("kind packing\nseed -1\n", &material), "whole number from 0");
  good &= rejected(scarp_material_parse("kind mohr-coulomb\nyoung 1e7\nfriction 120\n", &material), "is 120");
  good &= rejected(scarp_material_parse("kind packing\nsand a.sand\nfile a.packing\n", &material),
                   "'sand' stands beside 'file'");
  check("wrong materials are rejected with a reason", 13, good);

  good = rejected(scarp_points_set_gradients(points, few, 4), "2 points have 8");
  good &= rejected(scarp_points_set_gradients(points, NULL, 8), "null");
  numbers[5] = NAN;
  good &= rejected(scarp_points_set_gradients(points, numbers, 8), "point 1");
  numbers[5] = 0.0;
  good &= rejected(scarp_points_respond(points, 1, NULL), "set them first");
  good &= rejected(scarp_points_commit(points), "respond first");
  good &= rejected(scarp_points_stresses(points, numbers, 6), "respond first");
  good &= scarp_points_set_gradients(points, numbers, 8) == SCARP_DONE;
  good &= rejected(scarp_points_respond(points, -3, NULL), "threads");
  check("wrong sizes, NaN, null and wrong order of calls are rejected with a reason", 7, good);

  scarp_verdict worst;
  numbers[4] = -2.0; /* the second point turns inside out */
  good = scarp_points_set_gradients(points, numbers, 8) == SCARP_DONE;
  good &= scarp_points_respond(points, 1, &worst) == SCARP_NOT_ACCEPTABLE && worst.point == 1;
  good &= strcmp(worst.reason_name, "element_inverted") == 0 && rejected(scarp_points_commit(points), "acceptable");
  good &= scarp_points_verdict(points, 0, &worst) == SCARP_DONE && worst.status == 0;
  check("an inverted point is reported by number and reason, and not committed", worst.status, good);

  scarp_points* const freed = points;
  good = scarp_points_free(points) == SCARP_DONE && rejected(scarp_points_free(freed), "not alive");
  good &= rejected(scarp_points_commit(freed), "not alive") && rejected(scarp_points_commit(NULL), "null");
  good &= rejected(scarp_points_commit((scarp_points*)(void*)numbers), "not alive");
  int count = 0;
  good &= scarp_material_parse(texts[ELASTIC], &material) == SCARP_DONE;
  points =
      points_of(ELASTIC, 1); /* alive with the number that the material would have if each kind were counted alone */
  good &= rejected(scarp_points_count((scarp_points*)(void*)material, &count), "not alive");
  good &= scarp_points_free(points) == SCARP_DONE && scarp_material_free(material) == SCARP_DONE;
  check("handles that are freed, null, made up or of another kind are rejected with a reason", 5, good);
}
