// SPDX-License-Identifier: BSL-1.0
#include "run_scene.hpp"

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <utility>

#include "../shared/budget_report.hpp"
#include "../shared/print.hpp"
#include "../shared/run_options.hpp"
#include "older_results.hpp"
#include "scarp/budget/error_budget.hpp"
#include "scarp/fault/surface_log.hpp"
#include "scarp/observe/convergence_log.hpp"
#include "scarp/observe/distortion.hpp"
#include "scarp/observe/field_series.hpp"
#include "scarp/observe/packing_series.hpp"
#include "scarp/observe/probe.hpp"
#include "scarp/observe/progress.hpp"
#include "scarp/observe/totals.hpp"
#include "scarp/run/checkpointed_run.hpp"
#include "scarp/run/stop_signal.hpp"
#include "scarp/run/time_limit.hpp"
#include "sensitivity.hpp"
#include "summary.hpp"
#include "summary_table.hpp"
#include "team.hpp"
#include "water_log.hpp"

namespace fault_rupture {

namespace {

/// Takes the folder over, once: a new run before it writes its tables, a resumed one at its first attempt, since until
/// then its checkpoint may be rejected.
struct Takeover : scarp::NeverStops {
  scarp::RunFolder& folder;
  std::function<void()> also{};
  bool goes_on = false;
  bool done = false;

  Takeover(scarp::RunFolder& own, bool continues, std::function<void()> more)
      : folder(own), also(std::move(more)), goes_on(continues) {
    if (!goes_on) take();
  }
  void take() {
    if (std::exchange(done, true)) return;
    folder.begin();
    scarp::make_folder(folder.path() / "fields");
    remove_older_results(folder.path(), goes_on);
    if (also) also();
  }
  void attempted(Problem const&, scarp::StepReport const&) { take(); }

  static void members(auto&, auto&&) {}  // a resumed run takes its folder over anew
};

/// Of scenes that have a footing.
struct AnyFootingLog : scarp::NeverStops {
  std::optional<FootingLog<Footing>> log{};

  void attempted(Problem const& problem, scarp::StepReport const& report) {
    if (log) log->attempted(problem, report);
  }
  void ended(Problem const& problem, double load) {
    if (log) log->ended(problem, load);
  }
  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    if (self.log) visit("log", *self.log);
  }
};

/// Looks at the probe in the band beside points all over the ground.
scarp::ErrorBudget<Problem> error_budget(Choice const& choice, Scene const& scene, Problem const& problem, int probe) {
  scarp::ErrorSampling const sampling{.tracked = {probe}, .pressure_floor = scene.pressure_floor};
  scarp::ErrorBounds const usual{.unbalanced_largest = choice.unbalanced_tolerance};
  return scarp::ErrorBudget<Problem>(problem, examples::error_bounds(choice.budget, usual), sampling);
}

/// Where a run ended that found no balance before the fault moved.
std::string options_at_rest(Choice const& choice) {
  std::string options = "--unit-weight, --surcharge";
  if (choice.soil != Soil::dem) options += ", --young-modulus, --k0";
  if (choice.scene != Case::free) options += ", --bearing-pressure, --footing-width";
  return fmt::format("ground{} found no balance before the fault moved: compare {}\n",
                     choice.scene == Case::free ? "" : " and footing", options);
}

}  // namespace

int run(Choice const& choice, Scene const& scene, Start const& begun) {
  namespace fs = std::filesystem;
  scarp::CheckpointFiles& files = begun.files;
  auto const elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun.moment).count();
  };
  std::optional<scarp::ThreadExecutor> own_threads;
  auto& threads = begun.threads != nullptr ? *begun.threads : own_threads.emplace(threads_of_a_process(choice.threads));
  decltype(auto) executor = make_team(threads);
  if (executor.agree(files.resumes()) != files.resumes()) {
    scarp::reject(
        "checkpoints in '{}' are not the same for all ranks (each must see them to resume): use a folder that all "
        "share",
        choice.checkpoint);
  }
  auto problem = scene.problem(executor);
  fs::path const folder = begun.folder != nullptr ? begun.folder->path() : "";
  std::optional<Takeover> takeover;
  if (is_root_rank(executor)) {
    if (files.resumes()) examples::print(stderr, "{}resuming from '{}'\n", begun.name, files.newest().string());
    examples::print(stderr, "{}{} {} elements, {} threads, ground made after {:.1f} s\n", begun.name,
                    problem.discretisation().mesh().elements.size(), element_name, threads.threads(), elapsed());
    if (choice.length > 0.0 && problem.points().means() == nullptr) {
      examples::print(
          stderr,
          "warning: a --length of {} m reaches no neighbour of any point, so that the soil has none: take a "
          "longer one or a smaller --size\n",
          choice.length);
    }
    takeover.emplace(*begun.folder, files.resumes(), [&] {
      if (scene.write_packing) scene.write_packing(folder);
    });
  }
  double const depth = scene.ground.depth();
  scarp::LoadMeasure const measure{depth, "throw_over_depth", 0.0};  // no throw while a footing is placed
  double const to = scene.stages.throw_to;
  constexpr int profiles = 17;
  auto const start = files.resumes() ? scarp::CsvStart::resumed : scarp::CsvStart::anew;
  auto const& grid = problem.discretisation();
  auto const at = [&](double x, double y) {
    return grid.nearest_point(scarp::Vector<2>(x, scene.ground.surface_level() - depth + y));
  };
  auto const packings_of = [&](char const* probe, int point) {
    return scarp::PackingSeries(folder, probe, point, to, {0.0, 0.25, 0.5, 1.0}, measure);
  };
  auto budget = error_budget(choice, scene, problem, at(choice.probe_a_x, choice.probe_a_y));
  std::optional<WaterLog> water;  // on the root rank, which writes files
  scarp::StopSignal stop;         // on every rank: one that died of a signal would take the others with it
  scarp::OnRootRank observers(executor, [&] {
    water.emplace(folder, scene, depth, start);
    AnyFootingLog footing;
    if (scene.footing) footing.log.emplace(folder, *scene.footing, to, profiles, depth, start);
    return scarp::Observers(
        std::ref(*takeover), scarp::FieldSeries(folder, {.to = to, .count = choice.frames, .unit = depth}),
        scarp::SurfaceLog(folder / "surface.csv", to, profiles, depth, start),
        scarp::RveProbe(folder / "probe_A.csv", at(choice.probe_a_x, choice.probe_a_y), measure, start),
        scarp::RveProbe(folder / "probe_B.csv", at(choice.probe_b_x, choice.probe_b_y), measure, start),
        packings_of("A", at(choice.probe_a_x, choice.probe_a_y)),
        packings_of("B", at(choice.probe_b_x, choice.probe_b_y)), std::move(footing), std::ref(*water),
        scarp::ConvergenceLog(folder / "convergence.csv", measure, start), scarp::Progress(to, measure, begun.name),
        scarp::DistortionWarning<2>(
            [&](auto const& worst) {
              examples::print(
                  stderr,
                  "{}warning: element {} at ({:.2f}, {:.2f}) is sheared by {:.0f} % (mean ratio {:.2f}; 1 is regular, "
                  "0 without area): compare with another --pattern, or take a longer --length or less throw\n",
                  begun.name, worst.element, worst.place.x(), worst.place.y(), 100.0 * worst.shear, worst.mean_ratio);
            },
            0.2, "soil"),
        std::ref(budget), std::ref(stop), scarp::TimeLimit(choice.time_limit, begun.moment));
  });

  RunNotes notes{.used = examples::RunUsage(begun.moment)};
  AtRest& rest = notes.rest;
  scarp::CheckpointedRun stages(files, observers, notes);
  stages.stage([&] {
    auto const settled = scene.stages.settle(problem, stages);
    on_root_rank(problem, [&] { rest = at_rest(problem, scene); });
    return settled;
  });
  stages.stage([&] {
    auto const placed = scene.stages.place(problem, stages);
    rest.ground = scarp::ground_at_rest(problem);  // a checkpoint of this stage comes back here
    on_root_rank(problem, [&] { rest.solid_volume = scarp::solid_volume(problem); });
    notes.reaction_at_rest = scarp::generalised_reaction(problem);
    return placed;
  });
  stages.stage([&] { return scene.stages.rupture(problem, stages); });
  if (scene.stages.end > to) stages.stage([&] { return scene.stages.rest(problem, stages); });
  auto const& report = stages.report();
  bool const sound = !stages.stopped();  // all could be written
  if ((!report.verdict.acceptable() || scene.stages.end > to) && sound) observers.ended(problem, report.load);
  double const reaction = scarp::generalised_reaction(problem) - notes.reaction_at_rest;
  bool interrupted_later = false;  // in sensitivity runs, which the root rank alone runs
  on_root_rank(problem, [&] {
    takeover->take();  // also when nothing was left to do
    if (!sound) {
      // Its state first: there may be room for no more.
      begun.folder->end(stages.trouble());
      examples::print(stderr, "{}{}\n", begun.name, stages.trouble());
    }
    auto json = summary(choice, scene, problem, notes, reaction, report);
    water->add_to(json);
    json["run"] = examples::json_of(begun.folder->record());
    auto const written = [&](SensitivityResults const& sensitivity) {
      auto parts = budget.parts();
      auto const bounds = examples::error_bounds(choice.budget);
      for (auto& part : sensitivity_parts(sensitivity, json["surface_x50"], depth, bounds))
        parts.push_back(std::move(part));
      add_volume_part(parts, json, depth, bounds.volume);
      json["error_budget"] = examples::json_of(parts);
      examples::write_json(folder / "summary.json", json);
      std::string text = scarp::budget_headline(parts) + table(json) + "\n" + scarp::budget_table(parts);
      if (begun.sensitivity) text += sensitivity_lines(sensitivity);
      if (!report.verdict.acceptable()) {
        text =
            fmt::format("INCOMPLETE: stopped at h/H = {:.5f} ({}; last rejected step: {}, point {})\n",
                        std::max(report.load, 0.0) / depth, name(report.verdict.reason), name(report.last_failure),
                        report.worst_point) +
            (report.load > 0.0 || report.verdict.reason == scarp::Reason::interrupted ? "" : options_at_rest(choice)) +
            text;
      }
      scarp::write_file(folder / "summary.txt", text);
      return text;
    };
    std::string text = written({});  // the run's own results first: sensitivity runs take long
    if (!sound) return;
    if (begun.sensitivity && report.verdict.acceptable()) {
      text = written(begun.sensitivity(report));
      interrupted_later = choice.sensitivity_runs && stop.wants_stop();
    }
    auto const reason = interrupted_later ? scarp::Reason::interrupted : report.verdict.reason;
    bool const finished = report.verdict.acceptable() && !interrupted_later;
    begun.folder->end(finished ? "finished" : std::string(name(reason)));
    if (begun.sensitivity) examples::print(stdout, "{}", text);
  });
  if (!sound) return 1;
  constexpr int interrupted = 130;  // as a shell reports Ctrl-C
  if (interrupted_later) return interrupted;
  if (report.verdict.acceptable()) return 0;
  return report.verdict.reason == scarp::Reason::interrupted ? interrupted : 3;
}

}  // namespace fault_rupture
