// SPDX-License-Identifier: BSL-1.0
// Our side of a comparison with another DEM code: writes a packing as text, and steps such a packing on command.
//
// our_steps make spheres|discs GRAINS FILE   a packing at 200 kPa in a box without tilt, made without friction: no
// shear
//                                            forces yet, so that positions, radii and the law are the whole state
// our_steps run spheres|discs FILE SPEED DT  from FILE with fluctuations of up to SPEED [m/s] and time steps DT [s];
// commands
//                                            come by standard input, one a line:
//     start FILE   writes the state at the start, as `grains` below, with accelerations in the place of spins
//     steps N      makes N steps; prints CPU nanoseconds, near pairs, lists made
//     grains FILE  writes positions, velocities, spins; prints contacts, mean stress [Pa], share of contacts that slide
#include <fmt/format.h>
#include <fmt/os.h>

#include <cmath>
#include <ctime>
#include <fstream>
#include <iostream>
#include <string>

#include "scarp/contact/linear_frictional.hpp"
#include "scarp/core/build_info.hpp"
#include "scarp/dem/cloud.hpp"
#include "scarp/dem/contacts.hpp"
#include "scarp/dem/drive.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/shape/sphere.hpp"

namespace {

/// No damping at all, as in the peer.
struct Undamped {
  template <class T>
  T next_velocity(T const& velocity, T const& force, T const& mobility) const {
    return velocity + force * mobility;
  }
};

template <class GradingOf>
struct Comparison {
  using Grading = GradingOf;
  using Shape = typename Grading::Shape;
  using Packing = scarp::Packing<Shape, scarp::LinearFrictional>;
  using Stepper = scarp::TimeStepper<Packing, Undamped>;
  static constexpr int dim = Shape::dim;
  static constexpr double density = 2650.0;
  static constexpr double thickness = dim == 2 ? 0.2 : 1.0;
  static constexpr double pressure = 2e5;
  static constexpr int max_prepared =
      1600;  // more grains are copies side by side, which velocities at random make differ
  static constexpr double stiffness = dim == 2 ? 6e6 : 3e5;  // as in benchmarks/kernel_packings.hpp

  static scarp::LinearFrictional law() {
    return {.normal_stiffness = stiffness, .tangential_stiffness = stiffness, .friction = 0.55};
  }

  /// Consolidated without friction.
  static Packing smooth(int grains) {
    scarp::Cloud<Grading> const cloud{
        .grading = {.smallest = 4e-3, .largest = 6e-3}, .grains = grains, .density = density, .thickness = thickness};
    auto packing = cloud.template make<Packing>();
    scarp::LinearFrictional const springs{.normal_stiffness = stiffness, .tangential_stiffness = stiffness};
    scarp::Loading<dim> loading;
    for (int k = 0; k < dim; ++k) loading.controls.push_back(scarp::component_control<dim>(k, -pressure));
    scarp::TimeStepper<Packing> stepper;
    scarp::Servo const servo{.stress_tolerance = 1e-3, .unbalanced_tolerance = 1e-3};
    if (auto const verdict = servo.reach(stepper, packing, springs, loading); !verdict.acceptable())
      scarp::reject("{} grains were not consolidated ({}): take another number", grains, scarp::name(verdict.reason));
    if (!stepper.stop(packing, springs).acceptable()) scarp::reject("{} grains could not be stopped", grains);
    return packing;
  }

  static void make(int grains, std::string const& file) {
    int const sides = grains > max_prepared ? static_cast<int>(std::lround(std::sqrt(grains / max_prepared))) : 1;
    if (grains % (sides * sides) != 0)
      scarp::reject("{} grains are no {} x {} copies of one packing: take another number", grains, sides, sides);
    auto const packing = smooth(grains / (sides * sides));
    auto out = fmt::output_file(file);
    out.print("{} {} {:.17g} {:.17g} {:.17g} {:.17g}\n", dim, grains, density, thickness, stiffness, law().friction);
    for (int a = 0; a < dim; ++a) out.print("{:.17g} ", packing.cell(a, a) * (a < 2 ? sides : 1));
    out.print("{:.17g}\n", scarp::default_time_step_share * packing.pairs.critical_step);
    for (int copy = 0; copy < sides * sides; ++copy) {
      std::array<int, 3> const shift{copy % sides, copy / sides, 0};
      for (std::size_t i = 0; i < packing.grain_count(); ++i) {
        for (int a = 0; a < dim; ++a)
          out.print("{:.17g} ", packing.position(i, a) + shift[static_cast<std::size_t>(a)] * packing.cell(a, a));
        out.print("{:.17g}\n", packing.population->size(i)[0]);
      }
    }
  }

  /// Grains at rest; the box lies along the axes.
  static Packing read(std::string const& file) {
    std::ifstream in(file);
    int dimension = 0;
    std::size_t grains = 0;
    double skipped = 0.0;
    Packing packing;
    packing.cell.setZero();
    in >> dimension >> grains >> skipped >> skipped >> skipped >> skipped;
    for (int a = 0; a < dim; ++a) in >> packing.cell(a, a);
    in >> skipped;
    if (!in || dimension != dim || grains == 0) scarp::reject("'{}' is no packing of {} dimensions", file, dim);
    packing.position.resize(grains);
    packing.orientation.resize(grains);
    packing.rest();
    std::vector<scarp::SizeOf<Shape>> sizes(grains);
    for (std::size_t i = 0; i < grains; ++i) {
      for (int a = 0; a < dim; ++a) in >> packing.position(i, a);
      in >> sizes[i][0];
    }
    if (!in) scarp::reject("'{}' ends within its {} grains", file, grains);
    packing.population = std::make_shared<scarp::Population<Shape> const>(sizes, density, thickness);
    return packing;
  }

  Packing packing;
  Stepper stepper{};
  double time_step;
  long lists = 0;

  Comparison(std::string const& file, double speed, double duration) : packing(read(file)), time_step(duration) {
    scarp::Random random(1);
    for (std::size_t i = 0; i < packing.grain_count(); ++i) {
      for (int a = 0; a < dim; ++a) packing.velocity(i, a) = random.uniform(-speed, speed);
    }
    // Yade counts slip from the first step on, with the velocities of half a step before; LAMMPS begins with the next
    // one.
    if (dim == 2) packing.last_move.duration = time_step;
    if (!stepper.refresh(packing, law()).acceptable()) scarp::reject("'{}' has no list of near pairs", file);
    ++lists;
  }

  /// With the time step of the peer, whatever the critical one of the present list is.
  bool steps(long count) {
    scarp::Tensor<dim> const still = scarp::Tensor<dim>::Zero();
    for (long step = 0; step < count; ++step) {
      if (!(packing.pairs.drift <= packing.pairs.skin)) {
        if (!stepper.refresh(packing, law()).acceptable()) return false;
        ++lists;
      }
      stepper.time_step_share = time_step / packing.pairs.critical_step;
      if (!stepper.step(packing, law(), still).acceptable()) return false;
    }
    return true;
  }

  /// last: three numbers of a grain at most, after position and velocity
  template <class Last>
  void write(std::string const& file, Last const& last) const {
    auto out = fmt::output_file(file);
    for (std::size_t i = 0; i < packing.grain_count(); ++i) {
      for (int a = 0; a < dim; ++a) out.print("{:.17g} ", packing.position(i, a));
      for (int a = 0; a < dim; ++a) out.print("{:.17g} ", packing.velocity(i, a));
      auto const values = last(i);
      for (double const value : values) out.print("{:.17g} ", value);
      out.print("\n");
    }
  }

  void start(std::string const& file) const {
    std::vector<scarp::Vector<dim>> force(packing.grain_count(), scarp::Vector<dim>::Zero());
    scarp::for_each_contact(packing, law(), [&](auto const& contact) {
      force[contact.first] -= contact.force;
      force[contact.second] += contact.force;
    });
    write(file, [&](std::size_t i) -> scarp::Vector<dim> { return force[i] * packing.population->inverse_mass()[i]; });
  }

  bool grains(std::string const& file) {
    write(file, [&](std::size_t i) {
      std::array<double, static_cast<std::size_t>(scarp::spin_size<dim>)> spin{};
      for (int k = 0; k < scarp::spin_size<dim>; ++k) spin[static_cast<std::size_t>(k)] = packing.spin(i, k);
      return spin;
    });
    scarp::StepObservation<dim> seen;
    if (!stepper.observe(packing, law(), seen).acceptable()) return false;
    double sliding = 0.0;
    scarp::for_each_contact(packing, law(), [&](auto const& contact) {
      constexpr double near = 1.0 - 1e-9;
      if (contact.shear_force().norm() >= near * law().friction * contact.normal_force) sliding += 1.0;
    });
    fmt::print("{:.0f} {:.17g} {:.4f}\n", seen.contacts, seen.stress.trace() / dim, sliding / seen.contacts);
    return true;
  }
};

long long processor_nanoseconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return now.tv_sec * 1'000'000'000LL + now.tv_nsec;
}

template <class Side>
int obey(Side side) {
  fmt::print("{}\n", scarp::described(scarp::build_info()));
  std::fflush(stdout);
  std::string command;
  std::string argument;
  while (std::cin >> command >> argument) {
    if (command == "start") {
      side.start(argument);
      fmt::print("written\n");
    } else if (command == "steps") {
      long const lists = side.lists;
      auto const before = processor_nanoseconds();
      if (!side.steps(std::stol(argument))) scarp::reject("the packing failed within {} steps", argument);
      auto const after = processor_nanoseconds();
      fmt::print("{} {} {}\n", after - before, side.packing.pairs.count(), side.lists - lists);
    } else if (command == "grains") {
      if (!side.grains(argument)) scarp::reject("the packing could not be observed");
    } else {
      scarp::reject("unknown command '{}' (there are start, steps and grains)", command);
    }
    std::fflush(stdout);
  }
  return 0;
}

template <class Side>
int serve(std::vector<std::string> const& given) {
  if (given.size() == 4 && given[0] == "make") {
    Side::make(std::stoi(given[2]), given[3]);
    return 0;
  }
  if (given.size() == 5 && given[0] == "run") return obey(Side(given[2], std::stod(given[3]), std::stod(given[4])));
  scarp::reject("usage: our_steps make spheres|discs GRAINS FILE, or our_steps run spheres|discs FILE SPEED DT");
}

}  // namespace

int main(int count, char** arguments) try {
  std::vector<std::string> const given(arguments + 1, arguments + count);
  if (given.size() > 1 && given[1] == "discs") return serve<Comparison<scarp::DiscGrading>>(given);
  return serve<Comparison<scarp::SphereGrading>>(given);
} catch (std::exception const& problem) {
  fmt::print(stderr, "our_steps: {}\n", problem.what());
  return 2;
}
