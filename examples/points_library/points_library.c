/* SPDX-License-Identifier: BSL-1.0 */
/* How does a program in C use material points? Elastic ground, and a packing of discs, pressed along y. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "scarp_points.h"

/* Ends the program where a function was not done. */
static void must(int status) {
  if (status == SCARP_DONE) return;
  fprintf(stderr, "error: %s\n", scarp_last_error());
  exit(1);
}

/* Presses one point in steps and prints its last stress. */
static void press(char const* text, double strain, int steps, double stress[3], double tangent[9]) {
  scarp_material* material;
  scarp_points* points;
  must(scarp_material_parse(text, &material));
  must(scarp_points_create(material, 1, NULL, &points));
  must(scarp_material_free(material));
  for (int step = 0; step < steps; ++step) {
    double const gradient[4] = {0.0, 0.0, 0.0, -strain / steps};
    must(scarp_points_set_gradients(points, gradient, 4));
    must(scarp_points_respond(points, 1, NULL));
    must(scarp_points_tangents(points, tangent, 9));
    must(scarp_points_commit(points));
  }
  must(scarp_points_committed_stresses(points, stress, 3));
  printf("stress xx, yy, xy [Pa]: %.6g %.6g %.6g\n", stress[0], stress[1], stress[2]);
  must(scarp_points_free(points));
}

int main(void) {
  double stress[3], tangent[9];
  press("kind elastic\nyoung 20e6\npoisson 0.3\n", 1e-4, 1, stress, tangent);
  double const modulus = 20e6 * 0.7 / (1.3 * 0.4); /* E (1 - nu) / (1 + nu) / (1 - 2 nu) */
  int good = fabs(tangent[4] / modulus - 1.0) < 1e-12 && fabs(stress[1] / (-1e-4 * modulus) - 1.0) < 1e-4;
  press("kind packing\nshape disc\ngrains 100\npressure 1e5\n", 1e-3, 10, stress, tangent);
  good = good && stress[1] < -1.2e5 && stress[1] < stress[0] && stress[0] < -1e5; /* stiffer than nothing, both ways */
  return good ? 0 : 1;
}
