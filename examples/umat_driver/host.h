/* SPDX-License-Identifier: BSL-1.0 */
/* Hosts that call a UMAT, as Abaqus and Kratos do, and what C++ finds for the same increments. */
#ifndef UMAT_DRIVER_HOST_H
#define UMAT_DRIVER_HOST_H

#include "scarp_umat.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Materials that reference.cpp makes in C++, and that files describe: material_1.txt and so on. */
enum { ELASTIC = 1, MOHR_COULOMB = 2, DISCS = 3, ELASTIC_IN_SPACE = 4, MATERIALS = 4 };

/* A point of MaterialPoints in C++. Null where C++ throws. */
typedef struct reference reference;
reference* reference_new(int material);
void reference_free(reference* point);
/* Responds to a displacement gradient and commits where the response is acceptable; returns whether it is.
   Arrays are as in scarp_points.h. */
int reference_step(reference* point, double const* gradient, double* stress, double* tangent);
/* The gradient that umat_ makes of a strain with engineering shear in Abaqus' order, without rotation. */
void reference_gradient(int dimension, int components, double const* strain, double* gradient);

/* Prints a line with a figure, and counts it where it is not good. */
void check(char const* what, double figure, int good);
/* Whether the last error contains a text. */
int reports(char const* text);
/* Largest difference of two arrays, infinite where one is no number. */
double apart(double const* a, double const* b, int count);

/* Arrays of a host's point, each between numbers that nobody may change. */
typedef struct {
  double fence0[4], stress[6];
  double fence1[4], ddsdde[36];
  double fence2[4], strain[6];
  double fence3[4], pnewdt;
  double fence4[4];
  double* statev; /* committed, and four numbers of a fence behind */
  double* trial;
  int nstatv, ntens, material;
  double committed_stress[6];
} host_point;

void host_start(host_point* point, int material, int ntens, int nstatv);
void host_end(host_point* point);
int host_intact(host_point const* point);
/* Calls umat_ as Abaqus does, with all arrays, from the committed state. */
void abaqus_call(host_point* point, char const* name, double const* dstran);
/* Calls umat as Kratos does: null for what it has not, numbers of element and point zero. source: PROPS(3) */
void kratos_call(host_point* point, double const* dstran, int source);
/* The last trial becomes the committed state. */
void host_commit(host_point* point, double const* dstran);

/* Increment of strain of a step: 11, 22, 33, 12. */
void strain_of_step(int step, double* strain);
/* The reference's step by the gradient of a strain. */
void reference_strain_step(reference* known, int dim, int ntens, double const* strain, double* stress, double* tangent);
/* Largest difference of STRESS and DDSDDE of a host from a stress and tangent of C++. */
double difference(host_point const* point, int const* places, int size, int rows_first, double const* stress,
                  double const* tangent);
extern int const plane[3], short_plane[3], abaqus[6], kratos[6];
/* Length of STATEV for whole states. */
int whole_state(int material);
/* Of the materials: CMNAME, and text of the file. */
extern char const* const names[MATERIALS + 1];
extern char const* const texts[MATERIALS + 1];

void check_c_functions(void);
void check_wrong_input(void);
void check_sequences(void);
void check_first_steps(void);
void check_cut_back(void);
void check_deformation(void);
void check_rotation(void);
void check_plane_in_space(void);
void check_wrong_calls(void);

#ifdef __cplusplus
}
#endif

#endif
