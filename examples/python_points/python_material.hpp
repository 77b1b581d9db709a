// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "keywords.hpp"
#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/tensor/finite_strain.hpp"

namespace python_points {

/// A material that a program of Python has written as a class, see scarp.PythonMaterial. It sees the strain of an
/// increment before its rotation, and its stress is rotated here. Its states are numbers of C++, so that they are saved
/// and copied as all others.
/// \tparam Exact whether its tangents are the derivatives of its stresses
template <int Dim, bool Exact>
struct PythonMaterial {
  static constexpr int dim = Dim;
  static constexpr bool exact_tangent = Exact;
  static constexpr py::ssize_t size = scarp::voigt_size<Dim>;

  struct State {
    scarp::VoigtStress<Dim> stress = scarp::VoigtStress<Dim>::Zero();     ///< [Pa]
    scarp::VoigtTangent<Dim> tangent = scarp::VoigtTangent<Dim>::Zero();  ///< [Pa]
    std::vector<double> variables{};                                      ///< of the material's own
    bool is_answered = false;  ///< whether a call for many points has written this trial state
    scarp::Verdict verdict{};  ///< of that response

    SCARP_MEMBERS_EXCEPT((is_answered, verdict), stress, tangent, variables)
  };

  /// One point of a call for many.
  struct Request {
    PythonMaterial const* provider;
    State const* committed;
    scarp::Gradient<Dim> const* increment;
    scarp::NoPlan plan;
    State* trial;
  };

  std::shared_ptr<py::object const> own{};  ///< of the class
  bool is_of_many = false;                  ///< whether it has a function for all points in one call

  /// Takes an object over. \throws InputError for one without the functions of a material
  static PythonMaterial of(py::object const& object) {
    bool const is_of_many = py::hasattr(object, "respond_all");
    if (is_of_many == py::hasattr(object, "respond") || !py::hasattr(object, "start"))
      scarp::reject(
          "a material of the type {} has not the functions that are expected (start, and one of respond and "
          "respond_all): correct it",
          std::string(py::str(py::type::of(object))));
    auto* const kept = new py::object(object);
    auto const drop = [](py::object const* held) {
      if (!Py_IsInitialized()) return;
      py::gil_scoped_acquire const acquire;
      delete held;
    };
    return {std::shared_ptr<py::object const>(kept, drop), is_of_many};
  }

  State initial_state(scarp::Site<Dim> const& site) const {
    py::gil_scoped_acquire const acquire;
    return read(parts_of(own->attr("start")(site.position, site.depth), "start"), fmt::format("point {}", site.index));
  }
  scarp::VoigtStress<Dim> stress(State const& state) const { return state.stress; }
  scarp::VoigtTangent<Dim> tangent(State const& state) const { return state.tangent; }

  scarp::Response<Dim> respond(State const& committed, scarp::Gradient<Dim> const& increment, State& trial) const {
    if (!std::exchange(trial.is_answered, false)) {
      std::vector<Request> one{{this, &committed, &increment, {}, &trial}};
      is_of_many ? respond_together(one) : respond_alone(one.front());
      trial.is_answered = false;
    }
    return {trial.verdict.acceptable() ? trial.stress : committed.stress, trial.verdict};
  }

  bool takes_many() const { return is_of_many; }
  /// requests: of points with one provider
  static void respond_together(std::vector<Request> const& requests) {
    auto const& provider = *requests.front().provider;
    if (!provider.is_of_many) return;
    std::vector<Request> able;
    std::vector<scarp::RotatedIncrement<Dim>> moves;
    for (auto const& request : requests) {
      scarp::RotatedIncrement<Dim> const moved(*request.increment);
      *request.trial = *request.committed;
      request.trial->verdict = moved.verdict;
      if (!moved.verdict.acceptable()) continue;
      able.push_back(request);
      moves.push_back(moved);
    }
    if (!able.empty()) provider.answer(able, moves);
    for (auto const& request : requests) request.trial->is_answered = true;  // not where the material has raised
  }

  /// Named numbers of a state: the material's own variables.
  scarp::Quantities quantities(State const& state) const {
    static constexpr std::array<std::string_view, 8> names{"variable 0", "variable 1", "variable 2", "variable 3",
                                                           "variable 4", "variable 5", "variable 6", "variable 7"};
    scarp::Quantities named;
    for (std::size_t k = 0; k < std::min(names.size(), state.variables.size()); ++k)
      named.emplace_back(names[k], state.variables[k]);
    return named;
  }

 private:
  using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;
  struct Parts {
    Array stress, tangent, variables;
  };

  /// \throws InputError unless the function returned two or three arrays
  static Parts parts_of(py::object const& returned, char const* function) {
    if (!py::isinstance<py::tuple>(returned) || py::len(returned) < 2 || py::len(returned) > 3)
      scarp::reject(
          "{} of a material returned {} (a tuple of stress, tangent and, where it has some, variables is "
          "expected): correct it",
          function, scarp::shortened(std::string(py::repr(returned))));
    auto const part = [&](std::size_t k, char const* what) -> Array {
      require_unmasked(py::tuple(returned)[k], fmt::format("numbers of the {} that a material returned", what));
      Array array = Array::ensure(py::tuple(returned)[k]);
      if (!array) {
        PyErr_Clear();
        scarp::reject("{} of a material returned a {} that is no array of numbers: correct it", function, what);
      }
      return array;
    };
    return {part(0, "stress"), part(1, "tangent"),
            py::len(returned) == 3 ? part(2, "variables") : Array(std::vector<py::ssize_t>{0})};
  }

  static State read(Parts const& parts, std::string const& whose) {
    require_shape(parts.stress, {size}, "stress", whose);
    require_shape(parts.tangent, {size, size}, "tangent", whose);
    require_shape(parts.variables, {parts.variables.size()}, "variables", whose);
    State state;
    read_into(parts.stress.data(), parts.tangent.data(), state);
    state.variables.assign(parts.variables.data(), parts.variables.data() + parts.variables.size());
    return state;
  }
  static void read_into(double const* stress, double const* tangent, State& state) {
    std::copy_n(stress, size, state.stress.data());
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j < size; ++j) state.tangent(i, j) = tangent[i * size + j];
    }
  }
  static void require_shape(Array const& array, std::vector<py::ssize_t> const& expected, char const* what,
                            std::string const& whose) {
    std::vector<py::ssize_t> const found(array.shape(), array.shape() + array.ndim());
    if (found != expected)
      scarp::reject("the material of {} returned a {} of the shape ({}) ({} is expected): correct it", whose, what,
                    scarp::listed(found), scarp::listed(expected));
  }

  /// Rotates what the material returned; a trial that is not finite fails.
  static void end(State& trial, scarp::RotatedIncrement<Dim> const& moved) {
    scarp::Tensor<Dim> const unturned = scarp::from_voigt_stress<Dim, double>(trial.stress);
    trial.stress = scarp::to_voigt_stress<Dim, double>(moved.turn * unturned * moved.turn.transpose());
    if (!trial.stress.allFinite() || !trial.tangent.allFinite())
      trial.verdict = {scarp::Status::failed, scarp::Reason::not_finite};
  }

  void respond_alone(Request const& request) const {
    scarp::RotatedIncrement<Dim> const moved(*request.increment);
    State& trial = *request.trial;
    trial = *request.committed;
    trial.verdict = moved.verdict;
    if (!moved.verdict.acceptable()) return;
    {
      py::gil_scoped_acquire const acquire;
      Array const variables(static_cast<py::ssize_t>(trial.variables.size()), trial.variables.data());
      auto const strain = scarp::to_engineering_strain<Dim, double>(moved.strain);
      State answer = read(parts_of(own->attr("respond")(strain, trial.stress, variables), "respond"), "a point");
      if (answer.variables.size() != trial.variables.size())
        scarp::reject("respond of a material returned {} variables (it got {}): return as many",
                      answer.variables.size(), trial.variables.size());
      trial = std::move(answer);
    }
    end(trial, moved);
  }

  void answer(std::vector<Request> const& requests, std::vector<scarp::RotatedIncrement<Dim>> const& moves) const {
    auto const count = static_cast<py::ssize_t>(requests.size());
    auto const kept = static_cast<py::ssize_t>(requests.front().committed->variables.size());
    {
      py::gil_scoped_acquire const acquire;
      Array strains({count, size}), stresses({count, size}), variables({count, kept});
      for (py::ssize_t k = 0; k < count; ++k) {
        auto const n = static_cast<std::size_t>(k);
        auto const strain = scarp::to_engineering_strain<Dim, double>(moves[n].strain);
        State const& from = *requests[n].committed;
        if (static_cast<py::ssize_t>(from.variables.size()) != kept)
          scarp::reject(
              "a material with respond_all has {} variables at one point and {} at another: start with as many", kept,
              from.variables.size());
        std::copy_n(strain.data(), size, strains.mutable_data(k, 0));
        std::copy_n(from.stress.data(), size, stresses.mutable_data(k, 0));
        if (kept > 0) std::copy_n(from.variables.data(), kept, variables.mutable_data(k, 0));
      }
      auto const parts = parts_of(own->attr("respond_all")(strains, stresses, variables), "respond_all");
      auto const whose = fmt::format("{} points", count);
      require_shape(parts.stress, {count, size}, "stress", whose);
      require_shape(parts.tangent, {count, size, size}, "tangent", whose);
      if (kept > 0 || parts.variables.size() > 0) require_shape(parts.variables, {count, kept}, "variables", whose);
      for (py::ssize_t k = 0; k < count; ++k) {
        State& trial = *requests[static_cast<std::size_t>(k)].trial;
        read_into(parts.stress.data(k, 0), parts.tangent.data(k, 0, 0), trial);
        if (kept > 0) trial.variables.assign(parts.variables.data(k, 0), parts.variables.data(k, 0) + kept);
      }
    }
    for (std::size_t k = 0; k < requests.size(); ++k) end(*requests[k].trial, moves[k]);
  }
};

}  // namespace python_points
