// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/constitutive/geostatic_stress.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"
#include "scarp/tensor/finite_strain.hpp"
#include "scarp/tensor/voigt.hpp"

namespace scarp {

/// A user's material subroutine by the interface that Abaqus publishes, as Fortran compilers call it on Unix. A C
/// function without the last argument, the length of CMNAME, may be called so too. `extern "C" scarp::Umat umat_;`
/// declares it.
using Umat = void(double* stress, double* statev, double* ddsdde, double* sse, double* spd, double* scd, double* rpl,
                  double* ddsddt, double* drplde, double* drpldt, double* stran, double* dstran, double* time,
                  double* dtime, double* temp, double* dtemp, double* predef, double* dpred, char* cmname, int* ndi,
                  int* nshr, int* ntens, int* nstatv, double* props, int* nprops, double* coords, double* drot,
                  double* pnewdt, double* celent, double* dfgrd0, double* dfgrd1, int* noel, int* npt, int* layer,
                  int* kspt, int* kstep, int* kinc, std::size_t cmname_length);

namespace detail {

/// Numbers that a subroutine may use, between NaN that it must leave alone: what it computes with these is NaN too.
class FencedNumbers {
 public:
  explicit FencedNumbers(std::size_t count) : numbers_(count + 2 * width, std::bit_cast<double>(fence)) {
    std::fill_n(data(), count, 0.0);
  }
  double* data() { return numbers_.data() + width; }

  /// \throws InputError where a number outside was overwritten
  void require_intact(std::string_view name, std::string_view umat) const {
    auto const is_fence = [](double number) { return std::bit_cast<std::uint64_t>(number) == fence; };
    std::ptrdiff_t const count = std::ssize(numbers_) - 2 * static_cast<std::ptrdiff_t>(width);
    if (!std::all_of(numbers_.begin(), numbers_.begin() + width, is_fence) ||
        !std::all_of(numbers_.end() - width, numbers_.end(), is_fence))
      reject(
          "the UMAT '{}' wrote outside of {} (which has {} numbers): correct its loops, or give more of them, "
          "components "
          "included",
          umat, name, count);
  }

 private:
  static constexpr std::ptrdiff_t width = 40;                    // a DDSDDE of six components ends in it
  static constexpr std::uint64_t fence = 0x7ff8'5ca2'7000'f32c;  // a quiet NaN that no arithmetic makes

  std::vector<double> numbers_;
};

}  // namespace detail

/// A user's UMAT as provider: in the plane by four components (11, 22, 33, 12), in space by six (11, 22, 33, 12, 13,
/// 23), which `components = 6` gives in the plane too, for a UMAT that knows nothing else. Stress, total
/// strain and state variables are parts of the state, so that a trial never changes what is committed. The increment is
/// passed both as strain with rotation (DSTRAN, DROT; stress and strain are turned before) and as DFGRD0 and DFGRD1.
/// State variables that are tensors are turned by the UMAT, as for Abaqus; a mirrored copy of a state is rejected.
/// A UMAT that keeps something between calls (SAVE, COMMON) must not be called by several threads, and is no function
/// of its state.
/// \tparam Dim 2 or 3
/// \tparam InitialStress an `InitialStressField`
template <int Dim, class InitialStress = StressFree<Dim>>
  requires InitialStressField<InitialStress, Dim>
struct UmatProvider {
  static constexpr int dim = Dim;

  /// Where a point is.
  struct Place {
    Vector<3> position = Vector<3>::Zero();  ///< COORDS [m]
    int element = 1;                         ///< NOEL; without an element the point's number
    int number = 1;                          ///< in the element, NPT
    double size = 1.0;                       ///< of the element, CELENT [m]
  };

  /// What a UMAT reads and writes at a point.
  struct State {
    VoigtStress<3> stress = VoigtStress<3>::Zero();              ///< [Pa]
    EngineeringStrain<3> strain = EngineeringStrain<3>::Zero();  ///< STRAN
    std::vector<double> variables{};                             ///< STATEV
    Tensor<3> deformation = Tensor<3>::Identity();               ///< DFGRD0
    double time = 0.0;                                           ///< [s]
    Place place{};                                               ///< of the point, which is not saved
    VoigtTangent<Dim> tangent = VoigtTangent<Dim>::Zero();       ///< of the increment that led here [Pa]

    SCARP_MEMBERS_EXCEPT((place), stress, strain, variables, deformation, time, tangent)
  };

  Umat* umat = nullptr;               ///< address of the subroutine
  std::string name = "UMAT";          ///< CMNAME, which a UMAT gets in upper case
  std::vector<double> properties{};   ///< PROPS
  std::vector<double> variables{};    ///< STATEV at the start; its length is NSTATV
  InitialStress initial{};            ///< every point's start, by depth
  double time_step = 1.0;             ///< DTIME of an increment [s]
  int components = Dim == 2 ? 4 : 6;  ///< NTENS; 6 in the plane for a UMAT that is written for space alone

  /// The stress out of the plane starts as the horizontal one in it. The UMAT is called with a zero increment, for its
  /// tangent.
  /// \throws InputError for a provider without a UMAT, a name of more than 80 letters, another number of components, an
  /// initial stress that cannot be or that the UMAT does not keep, and for a UMAT without a tangent
  State initial_state(Site<Dim> const& site) const {
    if (!umat) reject("a UmatProvider has no UMAT (its address is null): give it one");
    if (name.size() > name_length)
      reject("the name of a UMAT's material has {} letters (at most {} are expected): shorten it", name.size(),
             name_length);
    require_positive("time step of a UMAT", time_step);
    if (components != 6 && !(Dim == 2 && components == 4))
      reject("a UMAT has {} components ({} expected): give as many", components,
             Dim == 2 ? "4, or 6 of one for space, are" : "6 are");
    VoigtStress<Dim> const start = initial_stress<Dim>(initial, site);
    Tensor<3> const stress = in_space<Dim>(from_voigt_stress<Dim, double>(start), start(0));
    State state = empty_state(site);
    state.stress = to_voigt_stress<3, double>(stress);
    state.variables = variables;
    State tried = state;
    if (!call(tried, state.deformation, Tensor<3>::Identity(), Tensor<3>::Zero()).acceptable())
      reject(
          "the UMAT '{}' does not bear a zero increment (its numbers are not finite, as where it reads beyond its "
          "arrays, or PNEWDT is below one): correct its properties, or give more of these{}",
          name, components == 4 ? ", of its state variables, or six components" : " and of its state variables");
    state.tangent = tried.tangent;
    if (state.tangent.isZero(0.0))
      reject("the UMAT '{}' leaves DDSDDE zero (solvers need the stiffness): let it set DDSDDE", name);
    constexpr double round_off = 1e-6, slightest_strain = 1e-9;
    double const tolerance = round_off * state.stress.norm() + slightest_strain * state.tangent.norm();
    if (!((tried.stress - state.stress).norm() <= tolerance))
      reject(
          "the UMAT '{}' changes the initial stress in a zero increment (normal stresses {:.6g}, {:.6g}, {:.6g} Pa "
          "become "
          "{:.6g}, {:.6g}, {:.6g}): let it add to STRESS, or give an initial stress that its material can bear",
          name, state.stress(0), state.stress(1), state.stress(2), tried.stress(0), tried.stress(1), tried.stress(2));
    return state;
  }

  /// The state of a point that is there.
  State empty_state(Site<Dim> const& site) const {
    State state;
    state.place.position.template head<Dim>() = site.position;
    state.place.element = 1 + (site.element < 0 ? site.index : site.element);
    state.place.number = 1 + site.place;
    state.place.size = site.size;
    return state;
  }

  /// For a state that comes from elsewhere.
  /// \throws InputError where it has another number of state variables
  void require_fitting(State const& state) const {
    if (state.variables.size() != variables.size())
      reject(
          "the state has {} state variables, the UMAT '{}' has {} (another UMAT has made it): give a state of points "
          "with one UMAT",
          state.variables.size(), name, variables.size());
  }

  VoigtStress<Dim> stress(State const& state) const { return part_of_stress<Dim>(state.stress); }

  VoigtTangent<Dim> tangent(State const& state) const { return state.tangent; }

  /// Not converged (`no_return`) where the UMAT sets PNEWDT below one, failed for an increment that inverts and for
  /// stress or state that is not finite; `trial` is then a copy of `committed`.
  /// \throws InputError where the UMAT wrote outside of its arrays
  Response<Dim> respond(State const& committed, Gradient<Dim> const& increment, State& trial) const {
    trial = committed;
    RotatedIncrement<Dim> const moved(increment);
    if (!moved.verdict.acceptable()) return {stress(committed), moved.verdict};
    Tensor<3> const deformation = Tensor<3>::Identity() + in_space<Dim>(increment, 0.0);
    Tensor<3> const strain = in_space<Dim>(moved.strain, 0.0), turn = in_space<Dim>(moved.turn, 1.0);
    State next = committed;
    next.deformation = deformation * committed.deformation;
    Verdict const verdict = call(next, committed.deformation, turn, turned<3>(turn, strain));
    if (!verdict.acceptable()) return {stress(committed), verdict};
    if (next.tangent.isZero(0.0) && !next.stress.isZero(0.0))
      reject(
          "the UMAT '{}' leaves DDSDDE zero in an increment (solvers need the stiffness): let it set DDSDDE at every "
          "call",
          name);
    trial = std::move(next);
    return {stress(trial), {}};
  }

 private:
  static constexpr std::size_t name_length = 80;
  /// Places of the UMAT's components in the order of VoigtStress<3>.
  static constexpr std::array<int, 6> places{0, 1, 2, 5, 4, 3};
  /// Components of the UMAT, of four as of six, that make up VoigtStress<Dim>.
  static constexpr std::array<int, 6> own = Dim == 2 ? std::array{0, 1, 3, 0, 0, 0} : std::array{0, 1, 2, 5, 4, 3};

  void copy(VoigtStress<3> const& from, double* to) const {
    for (int k = 0; k < components; ++k) to[k] = from(places[detail::index(k)]);
  }
  void copy(double const* from, VoigtStress<3>& to) const {
    for (int k = 0; k < components; ++k) to(places[detail::index(k)]) = from[k];
  }

  /// state: committed, with the deformation at the end; then the new one, and of no use where the verdict is not
  /// acceptable
  /// strain: of the increment, in axes that turn with it
  Verdict call(State& state, Tensor<3> const& before, Tensor<3> const& turn, Tensor<3> const& strain) const {
    Tensor<3> const start = turned<3>(turn, from_voigt_stress<3, double>(state.stress));
    Tensor<3> half = from_voigt_stress<3, double>(state.strain);  // its shear is that of engineering
    half += half.diagonal().asDiagonal();
    Tensor<3> const total = turned<3>(turn, half) / 2.0;
    auto const size = detail::index(components);
    detail::FencedNumbers stress(size), statev(state.variables.size()), ddsdde(size * size), props(properties.size());
    detail::FencedNumbers stran(size), dstran(size), ddsddt(size), drplde(size);
    detail::FencedNumbers time(2), predef(1), dpred(1), coords(3), drot(9), dfgrd0(9), dfgrd1(9);
    copy(to_voigt_stress<3, double>(start), stress.data());
    std::copy(state.variables.begin(), state.variables.end(), statev.data());
    std::copy(properties.begin(), properties.end(), props.data());
    copy(to_engineering_strain<3, double>(total), stran.data());
    copy(to_engineering_strain<3, double>(strain), dstran.data());
    std::fill_n(time.data(), 2, state.time);
    std::copy_n(state.place.position.data(), 3, coords.data());
    std::copy_n(turn.data(), 9, drot.data());
    std::copy_n(before.data(), 9, dfgrd0.data());
    std::copy_n(state.deformation.data(), 9, dfgrd1.data());
    double sse = 0.0, spd = 0.0, scd = 0.0, rpl = 0.0, drpldt = 0.0, temp = 0.0, dtemp = 0.0;
    double pnewdt = 1.0, celent = state.place.size, dtime = time_step;
    std::array<char, name_length> cmname;
    cmname.fill(' ');
    auto const letters = std::string_view(name).substr(0, name_length);  // a state may come from another name
    std::ranges::transform(letters, cmname.begin(), [](char letter) {
      return letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
    });
    int ndi = 3, nshr = components - 3, ntens = components, nstatv = detail::count(state.variables);
    int nprops = detail::count(properties), npt = state.place.number, layer = 1, kspt = 1, noel = state.place.element;
    std::array<int, 4> kstep{1, 0, 0, 0};
    int kinc = 1 + static_cast<int>(std::lround(state.time / time_step));
    umat(stress.data(), statev.data(), ddsdde.data(), &sse, &spd, &scd, &rpl, ddsddt.data(), drplde.data(), &drpldt,
         stran.data(), dstran.data(), time.data(), &dtime, &temp, &dtemp, predef.data(), dpred.data(), cmname.data(),
         &ndi, &nshr, &ntens, &nstatv, props.data(), &nprops, coords.data(), drot.data(), &pnewdt, &celent,
         dfgrd0.data(), dfgrd1.data(), &noel, &npt, &layer, &kspt, kstep.data(), &kinc, name_length);
    using Named = std::pair<detail::FencedNumbers const*, std::string_view>;
    for (auto const& [array, what] : std::initializer_list<Named>{{&stress, "STRESS"},
                                                                  {&statev, "STATEV"},
                                                                  {&ddsdde, "DDSDDE"},
                                                                  {&props, "PROPS"},
                                                                  {&stran, "STRAN"},
                                                                  {&dstran, "DSTRAN"},
                                                                  {&ddsddt, "DDSDDT"},
                                                                  {&drplde, "DRPLDE"},
                                                                  {&time, "TIME"},
                                                                  {&predef, "PREDEF"},
                                                                  {&dpred, "DPRED"},
                                                                  {&coords, "COORDS"},
                                                                  {&drot, "DROT"},
                                                                  {&dfgrd0, "DFGRD0"},
                                                                  {&dfgrd1, "DFGRD1"}})
      array->require_intact(what, name);
    for (int i = 0; i < voigt_size<Dim>; ++i) {
      for (int j = 0; j < voigt_size<Dim>; ++j)
        state.tangent(i, j) = ddsdde.data()[own[detail::index(j)] * components + own[detail::index(i)]];
    }
    copy(stress.data(), state.stress);
    std::copy_n(statev.data(), state.variables.size(), state.variables.begin());
    state.strain = to_engineering_strain<3, double>(total + strain);
    state.time += time_step;
    if (!(pnewdt >= 1.0)) return {Status::not_converged, Reason::no_return};
    auto const finite = [](double number) { return std::isfinite(number); };
    if (!state.stress.allFinite() || !state.tangent.allFinite() || !std::ranges::all_of(state.variables, finite))
      return {Status::failed, Reason::not_finite};
    return {};
  }
};

static_assert(ConstitutiveProvider<UmatProvider<2>>);
static_assert(ConstitutiveProvider<UmatProvider<3>>);
static_assert(ConstitutiveProvider<UmatProvider<2, GeostaticStress<2>>>);

}  // namespace scarp
