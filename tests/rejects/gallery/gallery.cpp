// SPDX-License-Identifier: BSL-1.0
// Wrong types, each in a namespace of its own; many are sound ones of the library of which a member is hidden by a
// number.
// The first error that a compiler reports of a namespace must have the words behind `first:`; g++, which goes on after
// a failed assertion, must also say the others.
#include "headers.hpp"

using namespace scarp;

using Discs = Packing<Disc, Frictionless>;
using Elements = Discretisation<Quad4>;
using Elastic = LinearElastic<2>;

// first: a shape needs `static constexpr int` dim
namespace case_1 {
struct Wrong {};
Packing<Wrong, Frictionless> packing;
}  // namespace case_1

// first: a shape needs `static double content(
// also: gyration_squared(
// also: bounding_radius(
// also: eccentricity(
// also: contact_radius(
// also: warm_starts_normal
// also: a shape needs `static std::array<T, pose_count> pose(
namespace case_2 {
struct Wrong {
  static constexpr int dim = 2, size_count = 1, orientation_count = 0, pose_count = 1;
};
Packing<Wrong, Frictionless> packing;
}  // namespace case_2

// first: a shape's orientation_count is 2
namespace case_axes {
struct Wrong : Disc {
  static constexpr int orientation_count = 1;
  template <class T>
  static std::array<T, 1> pose(std::array<T, 1> const& size, std::array<T, 1> const&) {
    return size;
  }
};
Packing<Wrong, Frictionless> packing;
}  // namespace case_axes

// first: a shape needs `static ContactGeometry<dim, T> touch(
namespace case_3 {
struct Wrong : Disc {
  static constexpr int touch = 0;
};
Packing<Wrong, Frictionless> packing;
}  // namespace case_3

// first: a shape is evaluated for several pairs at once
namespace case_4 {
struct Wrong : Disc {
  static double contact_radius(std::array<double, 1> const& pose) { return pose[0]; }
};
Packing<Wrong, Frictionless> packing;
}  // namespace case_4

// first: a contact law needs `static constexpr ContactInputs inputs
// also: a contact law needs `template <int Dim, class T>
// also: a contact law needs `ContactStiffness
namespace case_5 {
struct Wrong {};
Packing<Disc, Wrong> packing;
}  // namespace case_5

// first: a contact law needs `static constexpr ContactInputs inputs
namespace case_named_law {
struct Wrong {};
using Named = Packing<Disc, Wrong>;
static_assert(CheckedContactLaw<Wrong>);
}  // namespace case_named_law

// first: a shape needs `static constexpr int` dim
namespace case_named_shape {
struct Wrong {};
using Named = Packing<Wrong, Frictionless>;
static_assert(CheckedShape<Wrong>);
}  // namespace case_named_shape

// first: an element needs `static constexpr int` dim
namespace case_named_element {
struct Wrong {};
using Named = Discretisation<Wrong>;
static_assert(CheckedElement<Wrong>);
}  // namespace case_named_element

// first: needs `.shear = true`
namespace case_6 {
struct Wrong : LinearFrictional {
  static constexpr ContactInputs inputs{};
};
Packing<Disc, Wrong> packing;
}  // namespace case_6

// first: a contact law is evaluated for several contacts at once
namespace case_7 {
struct Wrong : Frictionless {
  ContactForce<2, double> respond(ContactKinematics<2, double> const&, ContactMemory<2, double>&) const {
    return {1.0};
  }
};
Packing<Disc, Wrong> packing;
}  // namespace case_7

// within: many_contacts_at_once
namespace case_8 {
struct Wrong : Frictionless {
  template <int Dim, class T>
  ContactForce<Dim, T> respond(ContactKinematics<Dim, T> const& approach, ContactMemory<Dim, T>&) const {
    if (approach.overlap < broadcast<T>(0)) return {broadcast<T>(0)};
    return {approach.overlap};
  }
};
Packing<Disc, Wrong> packing;
}  // namespace case_8

// first: an element needs `static constexpr int` dim
namespace case_9 {
struct Wrong {};
Mesh<Wrong> mesh;
}  // namespace case_9

// first: an element needs `static ShapeValues<Element> shape(
// also: shape_gradients(
// also: quadrature()
// also: `using Facet
// also: vtk_cell_type
namespace case_10 {
struct Wrong {
  static constexpr int dim = 2, nodes = 4;
};
Mesh<Wrong> mesh;
}  // namespace case_10

// first: an element needs `static constexpr facets()`
namespace case_11 {
struct Wrong : Quad4 {
  static constexpr int facets = 0;
};
BoxMesh<Wrong> box;
}  // namespace case_11

// first: a provider needs `static constexpr int dim`, 2 or 3
// also: a type `State`
namespace case_12 {
struct Wrong {};
auto const region = Region{"soil", Wrong{}};
}  // namespace case_12

// first: a provider needs `State initial_state(
// also: Response<dim> respond(
// also: stress(State
// also: tangent(State
namespace case_13 {
struct Wrong {
  static constexpr int dim = 2;
  struct State {};
};
auto const region = Region{"soil", Wrong{}};
}  // namespace case_13

// first: a provider needs `VoigtTangent<dim> tangent(
namespace case_14 {
struct Wrong : Elastic {
  static constexpr int tangent = 0;
};
auto const region = Region{"soil", Wrong{}};
}  // namespace case_14

// first: an observer needs `void attempted(
// also: wants_stop(
namespace case_19 {
struct Wrong {};
void watched(EquilibriumProblem<Elements>& problem, Wrong& wrong) {
  LoadStepping{}.settle(QuasiNewton<>{}, problem, 0.0, wrong);
}
}  // namespace case_19

// within: InitialStressField
namespace case_24 {
struct Wrong {};
LinearElastic<2, Wrong> soil;
}  // namespace case_24

// within: StrengthLaw
namespace case_25 {
struct Wrong {};
MohrCoulomb<2, StressFree<2>, Wrong> soil;
}  // namespace case_25

// within: PackingSource
namespace case_26 {
struct Wrong {};
DemRve<Discs, Wrong> rve;
}  // namespace case_26

// within: PackingTangent
namespace case_27 {
struct Wrong {};
DemRve<Discs, SamePacking<Discs>, Wrong> rve;
}  // namespace case_27

// first: a law per pair of species needs grains
namespace case_species {
Packing<WithSpecies<Disc, 3>, LawPerSpecies<Frictionless, 2>> packing;
}  // namespace case_species

// within: DampsMotion
namespace case_28 {
struct Wrong {};
DemRve<Discs, SamePacking<Discs>, AffineTangent, Wrong> rve;
}  // namespace case_28

// within: DampsMotion
namespace case_29 {
struct Wrong {
  double next_velocity(double velocity, double force, double mobility) const { return velocity + force * mobility; }
};
TimeStepper<Discs, Wrong> stepper;
}  // namespace case_29

// first: before_move of a damping is never called
namespace case_hook {
struct Wrong : LocalDamping {
  void before_move(Discs& packing, NetForces<Discs> const&, double) { packing.rest(); }
};
TimeStepper<Discs, Wrong> stepper;
}  // namespace case_hook

// Optional members of another form than is called, templates among them.
// first: before_move of a damping is never called
namespace case_hook_of_two {
struct Wrong : LocalDamping {
  template <class PackingType, class Forces>
  void before_move(PackingType const&, Forces const&) {}
};
TimeStepper<Discs, Wrong> stepper;
}  // namespace case_hook_of_two

// first: interaction_range of a law is never called
// also: damping_ratio of a law is never called
// also: bond of a law is never called
namespace case_options_of_law {
struct Wrong : Frictionless {
  template <class T>
  T interaction_range() const {
    return T(1e-3);
  }
  double damping_ratio(double speed) const { return speed; }
  static constexpr bool bond = true;
};
Packing<Disc, Wrong> packing;
}  // namespace case_options_of_law

// first: interaction_range of a law is never called
namespace case_option_of_final_law {
struct Wrong final : Frictionless {
  double interaction_range(int) const { return 1e-3; }
};
Packing<Disc, Wrong> packing;
}  // namespace case_option_of_final_law

// first: friction_coefficient of a law is never called
// also: friction of a law is never exchanged
// also: stored_energy of a law is never called
namespace case_options_of_wrapped_law {
struct Wrong : LinearFrictional {
  float friction = 0.5F;
  double friction_coefficient() const { return 0.5; }
  double stored_energy(double overlap) const { return overlap; }
};
Packing<WithSpecies<Disc, 2>, LawPerSpecies<Wrong, 2>> packing;
}  // namespace case_options_of_wrapped_law

// first: inner_radius of a shape is never called
// also: check of a shape is never called
namespace case_options_of_shape {
struct Wrong : Disc {
  static double inner_radius(double radius) { return radius; }
  void check(std::array<double, 1> const&) const {}
};
Packing<Wrong, Frictionless> packing;
}  // namespace case_options_of_shape

// first: quantities of a provider is never called
// also: balance of a provider is never called
// also: empty_state of a provider is never called
// also: picture of a provider is never called
// also: plan of a provider is never called
namespace case_options_of_provider {
struct Wrong : Elastic {
  int quantities(State const&) { return 0; }
  template <class T>
  int balance(State const&) const {
    return 0;
  }
  State empty_state() const { return {}; }
  int picture(State&) const { return 0; }
  int plan(State const&, Gradient<2> const&) const { return 1; }
};
StiffnessFloor<Wrong> soil;
}  // namespace case_options_of_provider

// first: validate is never called
namespace case_validate {
struct Wrong : LocalDamping {
  void validate(double) const {}
};
Verdict refreshed(TimeStepper<Discs, Wrong> const& stepper, Discs& packing) { return stepper.refresh(packing, {}); }
}  // namespace case_validate

// within: PreparesFromSeed
namespace case_30 {
struct Wrong {};
RandomPackings<Wrong> packings;
}  // namespace case_30

// within: Ground
namespace case_32 {
struct Wrong {
  using Element = Tri3;
};
FreeFieldFault<Elastic, QuasiNewton<>, Wrong> scene;
}  // namespace case_32

// first: a structure needs edges(), put_on()
namespace case_34 {
struct Wrong {};
auto const mesh = FaultScene<Elastic, Wrong>{}.mesh();
}  // namespace case_34

// within: many_pairs_at_once
namespace case_36 {
struct Wrong : Disc {
  template <class T>
  static ContactGeometry<2, T> touch(std::array<T, 1> const& first, std::array<T, 1> const& second,
                                     Point<2, T> const& branch, Point<2, T> const& normal) {
    if (branch[0] < broadcast<T>(0)) return Disc::touch(second, first, branch, normal);
    return Disc::touch(first, second, branch, normal);
  }
};
Packing<Wrong, Frictionless> packing;
}  // namespace case_36

// first: an attachment that is a field needs
namespace case_field {
struct Wrong : FollowingPressure<> {
  static constexpr bool is_field = true;
};
auto const size = sizeof(detail::AttachedFieldOf<2, Wrong>);
}  // namespace case_field

// first: time_error of a field is never called
// also: limit of a field is never called
// also: grid of a field is never called
namespace case_options_of_field {
struct Wrong : FollowingPressure<> {
  static constexpr bool is_field = true;
  void at(double) {}
  double next_knot(double load) const { return load; }
  std::string name() const { return {}; }
  double residual(Eigen::VectorXd const&) const { return 0.0; }
  std::string describe(int) const { return {}; }
  std::vector<NodalField> nodal_fields() const { return {}; }
  Eigen::VectorXd ground_force() const { return {}; }
  double time_error(double) const { return 0.0; }
  void limit(Eigen::VectorXd& next) const { next.setZero(); }
  int grid(int) const { return 0; }
};
auto const size = sizeof(detail::AttachedFieldOf<2, Wrong>);
}  // namespace case_options_of_field

// first: thickness of what is attached is never called
// also: add_stick_stiffness of what is attached is never called
// also: length of what is attached is never called
namespace case_options_of_attachment {
struct Wrong : FollowingPressure<> {
  double thickness(int) const { return 1.0; }
  void add_stick_stiffness(Eigen::SparseMatrix<double>&) const {}
  static constexpr bool length = true;
};
auto const size = sizeof(detail::AttachedPartOf<2, Wrong>);
}  // namespace case_options_of_attachment

// first: first_dof of a body is never called
// also: thickness of a body is never called
// also: length of a body is never called
namespace case_options_of_body {
struct Wrong : RigidFooting {
  long first_dof() const { return 0; }
  double thickness(int) const { return 1.0; }
  static constexpr bool length = true;
};
auto const size = sizeof(Interface<LinearFrictional, Wrong>);
}  // namespace case_options_of_body

// first: field of a structure is never called
// also: buoyancy of a structure is never called
// also: end of a structure is never called
namespace case_options_of_structure {
struct Wrong : NoStructure {
  void field(double) const {}
  double buoyancy(double) const { return 0.0; }
  double end() const { return 1.0; }
};
using Scene = FaultScene<Elastic, Wrong>;
auto field(Scene const& scene, Scene::Grid const& grid) { return detail::field_of(scene.structure, grid, 1.0); }
auto buoyancy(Scene const& scene) { return detail::buoyancy_of(scene.structure); }
auto end(Scene const& scene) { return scene.end(); }
}  // namespace case_options_of_structure

// first: mid_sides of an element is never called
namespace case_options_of_element {
struct Wrong : Quad4 {
  static constexpr int mid_sides = 4;
};
using Linear = LinearOf<Wrong>;
}  // namespace case_options_of_element

// first: ended of an observer is never called
namespace case_option_of_observer {
struct Wrong : NeverStops {
  template <class Problem>
  void attempted(Problem const&, StepReport const&) {}
  template <class Problem>
  void ended(Problem const&) {}
};
struct Ground {};
void end(Observers<Wrong>& observers) { observers.ended(Ground{}, 1.0); }
}  // namespace case_option_of_observer

// first: a CheckpointedRun watches all other observers
namespace case_observers {
struct Notes {
  int stages = 0;
  SCARP_MEMBERS(stages)
};
Observers<CheckpointedRun<Observers<>, Notes>>* observers = nullptr;
auto const count = sizeof(*observers);
}  // namespace case_observers
