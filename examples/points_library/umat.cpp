// SPDX-License-Identifier: BSL-1.0
// The functions of scarp_umat.h.
#include "scarp_umat.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <mutex>

#include "handles.hpp"
#include "materials.hpp"
#include "scarp/core/executor.hpp"
#include "scarp/points/material_points.hpp"
#include "umat_states.hpp"

namespace points_library {
namespace {

/// All that lives between calls.
struct Session {
  std::mutex mutex{};
  std::map<std::string, std::shared_ptr<Material const>> materials{};
  StateVariables states{};
  Memory memory{};
  std::atomic<long long> work = 0;
};

std::unique_ptr<Session>& session() {
  static auto one = std::make_unique<Session>();
  return one;
}

/// What a call is given, null where a host gives nothing.
struct Call {
  double* stress;
  double* statev;
  double* ddsdde;
  double const* stran;
  double const* dstran;
  char const* cmname;
  int const* ntens;
  int const* nstatv;
  double const* props;
  int const* nprops;
  double const* coords;
  double const* drot;
  double* pnewdt;
  double const* dfgrd0;
  double const* dfgrd1;
  bool rows_first;  ///< of ddsdde

  int property(int number, int most) const {
    if (!props || !nprops || *nprops < number) return 0;
    double const value = scarp::require_between(fmt::format("PROPS({})", number), props[number - 1], 0.0, 1.0 * most);
    if (value != std::floor(value))
      scarp::reject("PROPS({}) is {} (a whole number is expected): correct it", number, value);
    return static_cast<int>(value);
  }
  bool has_surface() const { return props && nprops && *nprops >= 4; }
  double surface() const { return has_surface() ? scarp::require_finite("PROPS(4), the surface,", props[3]) : 0.0; }
};

/// CMNAME ends at its first blank. A host that gives PROPS(1) need not have one.
std::string material_file(Call const& call) {
  constexpr int most = 80;
  if (int const number = call.property(1, 1'000'000); number > 0) return fmt::format("material_{}.txt", number);
  std::string name;
  for (char const* letter = call.cmname; letter && name.size() < most; ++letter) {
    bool const upper = *letter >= 'A' && *letter <= 'Z', lower = *letter >= 'a' && *letter <= 'z';
    if (!upper && !lower && !(*letter >= '0' && *letter <= '9') && *letter != '_' && *letter != '-') break;
    name += upper ? static_cast<char>(*letter + ('a' - 'A')) : *letter;
  }
  if (name.empty())
    scarp::reject(
        "neither PROPS(1) nor CMNAME names a material (a number, or letters, digits, _ and - are expected): "
        "give one");
  return name + ".txt";
}

std::shared_ptr<Material const> material_of_call(std::string const& file) {
  std::lock_guard const lock(session()->mutex);
  auto& material = session()->materials[file];
  if (!material) {
    char const* const folder = std::getenv("SCARP_MATERIALS");
    material = std::make_shared<Material const>(read_material(std::filesystem::path(folder ? folder : ".") / file));
  }
  return material;
}

template <int Dim>
scarp::MaterialPoints<Dim> initial_point(scarp::AnyProvider<Dim> const& provider, double depth) {
  return {provider, std::array{scarp::Site<Dim>{.depth = depth}}};
}

template <int Dim>
Outcome to_outcome(scarp::VoigtStress<Dim> const& stress, scarp::VoigtTangent<Dim> const& tangent) {
  Outcome outcome;
  outcome.stress.topLeftCorner<Dim, Dim>() = scarp::from_voigt_stress<Dim, double>(stress);
  outcome.tangent.topLeftCorner<scarp::voigt_size<Dim>, scarp::voigt_size<Dim>>() = tangent;
  return outcome;
}

/// start: null for a point's first state. An increment of zero finds the state as it is, without a DEM step.
/// total: strain by the host that the new state keeps
template <int Dim>
Outcome respond(scarp::AnyProvider<Dim> const& provider, State const& start, double depth, Tensor3 const& increment,
                Tensor3 const& total) {
  scarp::Gradient<Dim> const gradient = increment.topLeftCorner<Dim, Dim>();
  if (Dim == 2 && (!increment.row(2).isZero(0.0) || !increment.col(2).isZero(0.0)))
    scarp::reject(
        "the increment has a strain out of the plane (a plane material has none): use a material of "
        "dimension 3");
  auto point = initial_point(provider, depth);
  if (start) point.unpack(0, start->bits);
  Outcome outcome = to_outcome<Dim>(point.committed_stress(0), point.committed_tangent(0));
  if (!gradient.isZero(0.0)) {
    point.gradient(0) = gradient;
    scarp::SerialExecutor serial;
    auto const report = point.respond(serial);
    session()->work += report.inner_steps;
    outcome.verdict = report.verdict;
    if (!outcome.verdict.acceptable()) return outcome;
    outcome = to_outcome<Dim>(point.stress(0), point.tangent(0));
    point.commit();
  }
  outcome.after = start && gradient.isZero(0.0) ? start : std::make_shared<Snapshot const>(point.pack(0), total);
  return outcome;
}

/// Total strain by the host's account, where it is the source of increments; else what the state has of it.
Tensor3 total_strain(Call const& call, Components const& components, State const& start) {
  if (call.property(3, 2) == 1)
    return components.strain_tensor(given(call.stran, "STRAN")) +
           components.strain_tensor(given(call.dstran, "DSTRAN"));
  return start ? start->strain : Tensor3(Tensor3::Zero());
}

/// The increment of a call, in the host's axes.
Tensor3 increment_of(Call const& call, Components const& components, State const& start, Tensor3 const& total) {
  int const source = call.property(3, 2);
  using Matrix = Eigen::Map<Tensor3 const>;  // columns first, as Fortran's
  if (source == 2) {
    Matrix const before(given(call.dfgrd0, "DFGRD0")), after(given(call.dfgrd1, "DFGRD1"));
    return (after - before) * before.inverse();  // exactly zero without an increment
  }
  Tensor3 const turn = call.drot ? Tensor3(Matrix(call.drot)) : Tensor3(Tensor3::Identity());
  constexpr double round_off = 1e-4;  // of a host in single precision, over an analysis
  if (double const off = (turn * turn.transpose() - Tensor3::Identity()).norm(); !(off <= round_off))
    scarp::reject("DROT is no rotation (DROT times its transpose is {:.3g} off the identity): pass a rotation, or null",
                  off);
  if (!(turn.determinant() > 0.0)) scarp::reject("DROT is a reflection: pass a rotation, or null");
  if (source == 0) return gradient_of(components.strain_tensor(given(call.dstran, "DSTRAN")), turn);
  // The host has turned the strain before.
  return gradient_of(start ? Tensor3(total - turn * start->strain * turn.transpose()) : total, turn);
}

template <int Dim>
void write(Call const& call, Components const& components, Outcome const& outcome) {
  Tensor3 const& stress = outcome.stress;
  for (int i = 0; i < components.size; ++i) {
    int const row = components.place<Dim>(i);
    auto const [a, b] = components.pairs[scarp::detail::index(i)];
    if (outcome.verdict.acceptable())
      call.stress[i] =
          row < 0 ? 0.0 : stress(components.axis[scarp::detail::index(a)], components.axis[scarp::detail::index(b)]);
    for (int j = 0; j < components.size; ++j) {
      int const column = components.place<Dim>(j);
      call.ddsdde[call.rows_first ? i * components.size + j : j * components.size + i] =
          row < 0 || column < 0 ? 0.0 : outcome.tangent(row, column);
    }
  }
}

std::string request_of(std::string const& file, State const& start, double depth, Tensor3 const& increment,
                       Tensor3 const& total) {
  scarp::StateWriter request;
  request("file", file);
  request("start", start ? start->hash : 0);
  request("length", std::uint64_t{start ? start->bits.size() : 0});
  request("depth", start ? 0.0 : depth);
  request("increment", increment);
  request("total", total);
  return std::move(request.bits());
}

template <int Dim>
void call_material(Call const& call, std::string const& file, scarp::AnyProvider<Dim> const& provider) {
  int const ntens = *given(call.ntens, "NTENS");
  auto const components = Components::of(Dim, ntens, call.property(2, 1) == 1);
  std::span const statev(call.statev, scarp::detail::index(std::max(*given(call.nstatv, "NSTATV"), 0)));
  State const start = session()->states.read(statev);
  Tensor3 const total = total_strain(call, components, start);
  Tensor3 const increment = components.in_material_axes(increment_of(call, components, start, total));
  if (!increment.allFinite())
    scarp::reject("the increment of a point of '{}' is not finite: take a smaller step", file);
  double const height = call.coords ? call.coords[ntens == 6 ? 2 : 1] : call.surface();
  if (!start && call.has_surface()) scarp::require_below_surface(call.surface() - height);
  double const depth = std::max(call.surface() - height, 0.0);
  std::string const request = request_of(file, start, depth, increment, total);
  auto outcome = session()->memory.find(request);
  if (!outcome) {
    outcome = respond<Dim>(provider, start, depth, increment, total);
    session()->memory.add(request, *outcome);
  }
  auto const [status, reason] = outcome->verdict;
  if (outcome->verdict.acceptable()) {
    session()->states.write(outcome->after, statev);
  } else if (call.pnewdt) {
    *call.pnewdt = std::min(*call.pnewdt, 0.5);
  } else {
    scarp::reject("a point of '{}' is {} ({}), and PNEWDT is null (a smaller step cannot be requested): take one", file,
                  scarp::name(status), scarp::name(reason));
  }
  write<Dim>(call, components, *outcome);
}

void call_umat(Call const& call) noexcept {
  int const status = guarded([&] {
    given(call.stress, "STRESS"), given(call.ddsdde, "DDSDDE"), given(call.statev, "STATEV");
    auto const file = material_file(call);
    auto const material = material_of_call(file);
    std::visit([&](auto const& provider) { call_material(call, file, provider); }, *material);
  });
  if (status == SCARP_DONE) return;
  std::fprintf(stderr, "umat: %s\n", last_error().c_str());
  int const ntens = call.ntens ? std::clamp(*call.ntens, 0, 6) : 0;
  if (call.stress) std::fill_n(call.stress, ntens, std::nan(""));
  if (call.ddsdde) std::fill_n(call.ddsdde, ntens * ntens, std::nan(""));
}

}  // namespace
}  // namespace points_library

#pragma GCC diagnostic ignored "-Wunused-parameter"  // a host gives more than a material needs

extern "C" {

void umat_(SCARP_UMAT_ARGUMENTS) {
  points_library::call_umat({stress, statev, ddsdde, stran, dstran, cmname, ntens, nstatv, props, nprops, coords, drot,
                             pnewdt, dfgrd0, dfgrd1, false});
}
void umat(SCARP_UMAT_ARGUMENTS) {
  points_library::call_umat({stress, statev, ddsdde, stran, dstran, cmname, ntens, nstatv, props, nprops, coords, drot,
                             pnewdt, dfgrd0, dfgrd1, true});
}

int scarp_umat_state_numbers(scarp_material const* material, int* numbers) {
  return points_library::guarded([&] {
    using namespace points_library;
    auto const kept = material_at(material);
    std::string const bits =
        std::visit([](auto const& provider) { return initial_point(provider, 0.0).pack(0); }, *kept);
    *given(numbers, "the address of the number") =
        static_cast<int>(StateVariables::numbers({bits, Tensor3(Tensor3::Zero())}));
  });
}
int scarp_umat_work(long long* steps) {
  return points_library::guarded(
      [&] { *points_library::given(steps, "the address of the number") = points_library::session()->work; });
}
void scarp_umat_clear(void) {
  points_library::guarded([] { points_library::session() = std::make_unique<points_library::Session>(); });
}
}
