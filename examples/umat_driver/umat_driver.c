/* SPDX-License-Identifier: BSL-1.0 */
/* Do C++, C and a UMAT give the same bits? Sequences of calls of Abaqus and of Kratos, two materials, two threads, wrong input. */
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

int main(void) {
  char folder[] = "/tmp/umat_driver_XXXXXX";
  if (!mkdtemp(folder) || chdir(folder) != 0) return 2;
  write_materials();
  check_c_functions();
  check_wrong_input();
  check_sequences();
  check_cut_back();
  check_deformation();
  check_plane_in_space();
  check_wrong_calls();
  scarp_umat_clear();
  printf("%d wrong\n", wrong);
  return wrong == 0 ? 0 : 1;
}
