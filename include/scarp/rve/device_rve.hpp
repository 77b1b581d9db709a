// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/stored_packing.hpp"

namespace scarp {

/// A `DemRve` whose packings are on a device and respond there, many at once where the device takes many. Plans,
/// verdicts, tangents and saved states are the provider's, so that runs with and without a device resume each other;
/// stresses agree to round-off. A packing that the device cannot follow (a touch that needs a slow search, a list
/// beyond its room) responds on the processor.
/// \tparam Rve a `DemRve` with periodic boundaries and a damping that needs no more than the time step
template <class Rve>
struct DeviceRve {
  static constexpr int dim = Rve::dim;                ///< of the packing
  using Plan = typename Rve::Plan;                    ///< DEM time steps of one response
  using PackingType = decltype(Rve::State::packing);  ///< of the points
  using Types = BlockTypesOf<PackingType>;            ///< numbers of grains and pairs
  using Damping = decltype(Rve::damping);             ///< of the grains' motion
  using Device = BlockDevice<Types, Damping>;         ///< where packings respond
  using Stored = StoredPacking<PackingType, Device>;  ///< where a packing is
  static_assert(std::same_as<decltype(Rve::boundary), Periodic>,
                "scarp: packings on a device have periodic boundaries: take `Periodic`");

  /// A response that was evaluated together with others.
  struct Evaluated {
    std::shared_ptr<Stored const> from;  ///< packing before it
    Gradient<dim> increment;             ///< to which it responded
    Plan steps;                          ///< in so many DEM steps
    Response<dim> response;              ///< stress [Pa] and verdict
  };

  /// As the provider's, but for where the grains are.
  struct State {
    typename Rve::State outline;           ///< its packing has a cell and no grains
    std::shared_ptr<Stored const> stored;  ///< the whole packing
    std::optional<Evaluated> evaluated;    ///< of which this is the state, until `respond` returns it

    /// For saving, see `Described`: as the provider's state.
    template <class Self, class Visit>
    static void members(Self& self, Visit&& visit) {
      SCARP_ALL_MEMBERS(outline, stored, evaluated);
      if constexpr (std::is_const_v<Self>) {
        visit("packing", self.stored ? self.stored->packing() : self.outline.packing);
      } else {
        auto packing = self.stored ? self.stored->packing() : self.outline.packing;
        visit("packing", packing);
        self.take(std::move(packing));
      }
      visit("stress", self.outline.stress);
      visit("unbalanced_ratio", self.outline.unbalanced_ratio);
      visit("kinetic_share", self.outline.kinetic_share);
      visit("inertial_number", self.outline.inertial_number);
      visit("verdict", self.outline.verdict);
    }

    /// The provider's state, with all grains.
    typename Rve::State whole() const {
      auto state = outline;
      if (stored) state.packing = stored->packing();
      return state;
    }
    /// Another packing, which is on the processor.
    void take(PackingType packing) {
      outline.packing = detail::outline_of(packing);
      stored = std::make_shared<Stored const>(std::move(packing));
    }
  };

  /// One response of several.
  struct Request {
    DeviceRve const* provider;       ///< of all points
    State const* committed;          ///< of the point
    Gradient<dim> const* increment;  ///< since that state
    Plan steps;                      ///< DEM steps
    State* trial;                    ///< to be written
  };

  Rve rve{};                       ///< law, packings and accuracy
  std::shared_ptr<Device> device;  ///< where the packings are

  /// \throws InputError without a device, and for parameters that no response can be made with
  void validate() const {
    if (!device) reject("packings have no device to respond on (it is null): make one");
    rve.validate();
  }

  /// The provider's state, on the device.
  /// \throws InputError as the provider's, and where the device responds otherwise than the processor does
  State initial_state(Site<dim> const& site) const {
    validate();
    State state = state_of(rve.initial_state(site));
    auto const& packing = state.stored->packing();
    auto const grains = static_cast<int>(packing.grain_count());
    auto const pairs = static_cast<int>(packing.pairs.count());
    if (!device->room(grains, pairs))
      reject(
          "the packing of point {} has {} grains and {} near pairs (the device has no such room): take fewer grains, "
          "or add a BlockSize to SCARP_CUDA_DEVICE",
          site.index, grains, pairs);
    if (state.outline.verdict.status != Status::fluid)
      std::call_once(device->compared, [&] { require_equal_response(state); });
    return state;
  }

  /// The provider's stress [Pa].
  VoigtStress<dim> stress(State const& state) const { return rve.stress(state.outline); }

  /// Stiffness [Pa] of the state's packing for engineering strain, as the provider's tangent.
  VoigtTangent<dim> tangent(State const& state) const {
    if constexpr (!std::same_as<decltype(rve.tangent_policy), AffineTangent> || requires { rve.law.laws; }) {
      return rve.tangent(state.whole());
    } else {
      auto const [place, header] = state.stored->on(device, parameters());
      if (header.trouble != Trouble::none) return rve.tangent(state.whole());
      VoigtTangent<dim> tangent;
      auto number = header.stiffness.begin();
      for (int p = 0; p < tangent.rows(); ++p) {
        for (int q = p; q < tangent.cols(); ++q) tangent(p, q) = tangent(q, p) = *number++;
      }
      return tangent / state.outline.packing.volume();
    }
  }

  /// DEM steps of a response, as the provider plans them.
  Plan plan(State const& committed, Gradient<dim> const& increment) const {
    return with_list(committed, [&](auto const& own) { return rve.plan(own, increment); });
  }
  Plan refined(Plan steps) const { return rve.refined(steps); }  ///< Twice the steps.

  /// Response to a displacement gradient in as many DEM steps as plan() gives.
  Response<dim> respond(State const& committed, Gradient<dim> const& increment, State& trial) const {
    return respond(committed, increment, trial, plan(committed, increment));
  }
  /// Response in so many DEM steps, with the provider's verdicts.
  Response<dim> respond(State const& committed, Gradient<dim> const& increment, State& trial, Plan steps) const {
    auto const& known = trial.evaluated;
    if (!known || known->from != committed.stored || known->steps != steps || known->increment != increment) {
      Request const request{this, &committed, &increment, steps, &trial};
      respond_together(std::span(&request, 1));
    }
    auto const response = trial.evaluated->response;
    trial.evaluated.reset();
    return response;
  }

  /// Whether all points are to respond in one call.
  bool takes_many() const { return device && device->takes_many(); }
  /// Writes the trial states of all requests, which have one provider, each with the response that `respond` then
  /// returns.
  static void respond_together(std::span<Request const> requests) { requests.front().provider->respond_to(requests); }

  /// The provider's, of the packing that is read from the device.
  auto quantities(State const& state) const { return rve.quantities(state.whole()); }
  /// The packing as a drawing needs it.
  auto picture(State const& state) const requires requires { rve.picture(state.outline); }
  { return rve.picture(state.whole()); }
  auto balance(State const& state) const { return rve.balance(state.outline); }  ///< The provider's.
  /// \throws InputError as the provider's
  void require_fitting(State const& state) const { rve.require_fitting(state.whole()); }

 private:
  static State state_of(typename Rve::State own) {
    State state;
    PackingType packing = std::move(own.packing);
    state.outline = std::move(own);
    state.take(std::move(packing));
    return state;
  }

  BlockParameters<Types, Damping> parameters() const { return {rve.law, rve.damping, rve.time_step_share}; }

  /// Calls use(state of the provider) with an outline, or with all grains where the next step makes another list.
  template <class Use>
  auto with_list(State const& state, Use const& use) const {
    auto const& pairs = state.outline.packing.pairs;
    if (pairs.basis.agrees_with(list_basis(state.outline.packing, rve.law, pairs.skin))) return use(state.outline);
    return use(state.whole());
  }

  void respond_to(std::span<Request const> requests) const {
    std::vector<BlockTask<Types>> tasks;
    std::vector<typename Device::Bytes> memory;
    std::vector<Request const*> requested;
    std::vector<Request const*> for_processor;
    for (auto const& request : requests) {
      request.trial->stored = request.committed->stored;  // its own memory serves the new state
      request.trial->evaluated.reset();
      auto const& committed = *request.committed;
      auto& outline = request.trial->outline;
      double const rate = with_list(
          committed, [&](auto const& own) { return rve.inertial_number_of(own, *request.increment, request.steps); });
      outline = committed.outline;
      outline.inertial_number = rate;
      Tensor<dim> const strain_step = logarithm_of_increment<dim>(*request.increment) / request.steps;
      if (!strain_step.allFinite()) {
        fail(request, Reason::not_finite);
        continue;
      }
      auto const [state, header] = committed.stored->on(device, parameters());
      auto const room = device->room(header.grains, header.pairs);
      if (header.trouble != Trouble::none || !room) {
        for_processor.push_back(&request);
        continue;
      }
      auto const size = *room;
      memory.push_back(device->allocate(BlockState<Types>::bytes(size)));
      tasks.push_back({state, BlockState<Types>(memory.back().get(), size), device->grains(outline.packing.population),
                       request.steps, detail::row_by_row<dim>(strain_step)});
      requested.push_back(&request);
    }
    std::vector<BlockHeader<dim>> headers(tasks.size());
    device->respond(tasks, parameters(), headers);
    for (std::size_t k = 0; k < tasks.size(); ++k)
      finish(*requested[k], headers[k], std::move(memory[k]), tasks[k].trial.size);
    for (auto const* request : for_processor) respond_here(*request);
  }

  void finish(Request const& request, BlockHeader<dim> const& header, typename Device::Bytes bytes,
              BlockSize size) const {
    switch (header.trouble) {
      case Trouble::none: break;
      case Trouble::not_finite: return fail(request, Reason::not_finite);
      case Trouble::cell_collapsed: return fail(request, Reason::cell_collapsed);
      case Trouble::lost_grain: return fail(request, Reason::lost_grain);
      case Trouble::unconverged_touch:
      case Trouble::list_full: return respond_here(request);
    }
    auto& outline = request.trial->outline;
    auto& packing = outline.packing;
    packing.cell = detail::as_tensor<dim>(header.cell);
    packing.last_move = {detail::as_tensor<dim>(header.gradient), header.duration, header.applied != 0};
    packing.pairs.drift = header.drift;
    packing.pairs.skin = header.skin;
    packing.pairs.critical_step = header.critical_step;
    packing.pairs.basis = list_basis(packing, rve.law, header.skin);
    double const volume = packing.volume();
    StepObservation<dim> seen{.stress = -detail::as_tensor<dim>(header.moment) / volume,
                              .contacts = header.contacts,
                              .deepest_overlap = header.deepest};
    if (header.contacts > 0.0)
      seen.unbalanced_ratio = (header.unbalanced / header.grains) / (header.force / header.contacts);
    outline.verdict = rve.judge(outline, seen, -detail::as_tensor<dim>(header.kinetic).trace() / volume);
    if (outline.verdict == Verdict{}) outline.verdict = rve.verdict_of_steps(*request.increment, request.steps);
    request.trial->stored = std::make_shared<Stored const>(device, packing, std::move(bytes), size, header);
    keep(request);
  }

  void respond_here(Request const& request) const {
    typename Rve::State own;
    static_cast<void>(rve.respond(request.committed->whole(), *request.increment, own, request.steps));
    *request.trial = state_of(std::move(own));
    keep(request);
  }
  void fail(Request const& request, Reason reason) const {
    request.trial->outline.verdict = {Status::failed, reason};
    request.trial->stored = request.committed->stored;
    keep(request);
  }
  void keep(Request const& request) const {
    auto const& outline = request.trial->outline;
    request.trial->evaluated = {
        request.committed->stored, *request.increment, request.steps, {outline.stress, outline.verdict}};
  }

  /// \throws InputError where device and processor respond differently, as by a law that was compiled to nothing for
  /// the device
  void require_equal_response(State const& state) const {
    constexpr int steps = 20;
    constexpr double tolerance = std::same_as<typename Types::Scalar, double> ? 1e-9 : 1e-3;
    Gradient<dim> strain = Gradient<dim>::Zero();
    strain(0, 0) = -steps * rve.strain_per_step;
    strain(0, 1) = -strain(0, 0);
    typename Rve::State here;
    State there;
    Response<dim> const expected = rve.respond(state.whole(), strain, here, steps);
    Response<dim> const found = respond(state, strain, there, steps);
    if (!there.stored->is_on(device))
      reject(
          "the device cannot follow its first packing (a touch is not found, as where a function of the shape lacks "
          "`constexpr`): write the word before every function of the shape");
    if ((found.stress - expected.stress).norm() <= tolerance * expected.stress.norm()) return;
    reject(
        "a packing on the device responds with {:.6g} Pa (xx; the processor finds {:.6g}): write `constexpr` before "
        "every function that the contact law and the shape call",
        found.stress(0), expected.stress(0));
  }
};

}  // namespace scarp
