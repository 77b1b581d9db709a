/* SPDX-License-Identifier: BSL-1.0 */
/* Do C++, C and a UMAT give the same bits? Sequences of calls of Abaqus and of Kratos, two materials, three threads,
   wrong input. */
#define _POSIX_C_SOURCE 200809L
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "host.h"

static int wrong = 0;
char const* const names[MATERIALS + 1] = {"", "ELASTIC", "SOIL", "DISCS", "ROCK"};
char const* const texts[MATERIALS + 1] = {
    "", "kind elastic\nyoung 20e6\npoisson 0.3\n",
    "kind mohr-coulomb\nyoung 20e6\npoisson 0.3\ncohesion 1e3\nfriction 30\ndilation 5\nsurcharge 1e3\n",
    "kind packing\nshape disc # of 4 to 6 mm\ngrains 100\npressure 1e5\n",
    "kind elastic\ndimension 3\nyoung 20e6\npoisson 0.3\n"};

void check(char const* what, double figure, int good) {
  printf("%-72s %12.5g  %s\n", what, figure, good ? "ok" : "WRONG");
  wrong += !good;
}
int reports(char const* text) { return strstr(scarp_last_error(), text) != NULL; }
double apart(double const* a, double const* b, int count) {
  double worst = 0.0;
  for (int k = 0; k < count; ++k) {
    double const one = fabs(a[k] - b[k]);
    if (isnan(one)) return INFINITY;
    worst = fmax(worst, one);
  }
  return worst;
}

/* The file of a material by its number, or by CMNAME in small letters. */
static void path_of(int material, int by_name, char path[32]) {
  if (by_name) snprintf(path, 32, "%s.txt", names[material]);
  if (!by_name) snprintf(path, 32, "material_%d.txt", material);
  for (char* letter = path; *letter; ++letter) *letter = (char)tolower(*letter);
}

static void write_materials(void) {
  char path[32];
  for (int k = 0; k < 2 * MATERIALS; ++k) {
    path_of(k / 2 + 1, k % 2, path);
    FILE* file = fopen(path, "w");
    if (!file || fputs(texts[k / 2 + 1], file) < 0 || fclose(file) != 0) abort();
  }
}
static void remove_files(char const* folder) {
  char path[32];
  for (int k = 0; k < 2 * MATERIALS; ++k) {
    path_of(k / 2 + 1, k % 2, path);
    remove(path);
  }
  remove("points.scarp");
  if (chdir("..") == 0) rmdir(folder);
}

int main(void) {
  char folder[] = "umat_driver_XXXXXX";
  if (!mkdtemp(folder) || chdir(folder) != 0) {
    perror("umat_driver: no folder for materials in the current one (start it where files can be written)");
    return 2;
  }
  write_materials();
  check_c_functions();
  check_wrong_input();
  check_sequences();
  check_first_steps();
  check_cut_back();
  check_deformation();
  check_rotation();
  check_plane_in_space();
  check_wrong_calls();
  scarp_umat_clear();
  remove_files(folder);
  printf("%d wrong\n", wrong);
  return wrong == 0 ? 0 : 1;
}
