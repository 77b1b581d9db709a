// SPDX-License-Identifier: BSL-1.0
#include "scarp/observe/convergence_log.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <sstream>
#include <string_view>
#include <vector>

#include "support/files.hpp"
#include "support/refusals.hpp"

namespace {

using samples::content;
using samples::ScratchFolder;

struct NoProblem {};

/// Two iterations whose second one is accepted.
scarp::StepReport two_iterations() {
  scarp::StepReport report{.step = 3, .load = 0.5, .load_increment = 0.125};
  report.history.resize(2);
  auto& first = report.history[0];
  first = {.residual = 0.5, .inner_steps = 64, .material_seconds = 1.5, .seconds = 2.0};
  first.verdict = {scarp::Status::not_converged, scarp::Reason::unbalanced};
  first.worst_point = 2;
  first.points.add(0, scarp::Status::ok, 20);
  first.points.add(1, scarp::Status::fluid, 0);
  first.points.add(2, scarp::Status::not_converged, 44);
  report.history[1] = {
      .residual = 0.125, .linear_residual = 1e-15, .inner_steps = 20, .material_seconds = 1.5, .seconds = 1.75};
  report.max_displacement_gradient = 0.01;
  report.condition = 1e6;
  report.seconds = 4.0;
  return report;
}

}  // namespace

TEST_CASE("every iteration and every attempt is a line of JSON beside the table") {
  ScratchFolder const folder;
  scarp::ConvergenceLog log(folder / "convergence.csv", {2.0, "axial_strain"});
  log.attempted(NoProblem{}, two_iterations());
  auto refused = two_iterations();
  refused.history.resize(1);
  refused.history[0].residual = std::numeric_limits<double>::quiet_NaN();
  refused.verdict = {scarp::Status::failed, scarp::Reason::not_finite};
  refused.worst_point = 2;
  log.attempted(NoProblem{}, refused);
  // From the reports above by hand: numbers are exact in binary or shortest.
  using Fields = std::vector<std::string_view>;
  Fields const first{R"("kind":"iteration")",
                     R"("attempt":1,)",
                     R"("step":3,)",
                     R"("axial_strain":0.25,)",
                     R"("iteration":1,)",
                     R"("residual":0.5,)",
                     R"("rate":null,)",
                     R"("points":{"ok":1,"fluid":1,"not_converged":1,"failed":0})",
                     R"("reason":"unbalanced")",
                     R"("worst_point":2,)",
                     R"("slowest":[{"point":2,"dem_steps":44},{"point":0,"dem_steps":20}])",
                     R"("dem_steps":64,)",
                     R"("seconds":2,)",
                     R"("seconds_in_points":1.5})"};
  Fields const second{R"("kind":"iteration")",       R"("iteration":2,)",  R"("residual":0.125,)", R"("rate":0.25,)",
                      R"("linear_residual":1e-15,)", R"("reason":"none")", R"("worst_point":-1,)", R"("slowest":[])"};
  Fields const accepted{R"("kind":"step")",
                        R"("attempt":1,)",
                        R"("load_increment":0.125,)",
                        R"("accepted":true,)",
                        R"("status":"ok")",
                        R"("reason":"none")",
                        R"("weak_dof":-1,)",
                        R"("iterations":2,)",
                        R"("residual":0.125,)",
                        R"("max_displacement_gradient":0.01,)",
                        R"("condition":1000000,)",
                        R"("dem_steps":84,)",
                        R"("seconds":4,)",
                        R"("seconds_in_points":3,)",
                        R"("share_outside_points":0.25})"};
  Fields const failed{R"("kind":"iteration")", R"("attempt":2,)", R"("residual":null,)", R"("reason":"unbalanced")"};
  Fields const refusal{R"("kind":"step")",     R"("attempt":2,)",          R"("accepted":false,)",
                       R"("status":"failed")", R"("reason":"not_finite")", R"("worst_point":2,)",
                       R"("iterations":1,)",   R"("residual":null,)",      R"("share_outside_points":0.625})"};
  std::istringstream lines(content(folder / "convergence.jsonl"));
  std::string line;
  for (auto const& fields : {first, second, accepted, failed, refusal}) {
    REQUIRE(std::getline(lines, line));
    CAPTURE(line);
    for (auto const& field : fields) {
      CAPTURE(field);
      CHECK(line.find(field) != std::string::npos);
    }
  }
  CHECK_FALSE(std::getline(lines, line));
  std::string const table = content(folder / "convergence.csv");
  CHECK(std::count(table.begin(), table.end(), '\n') == 4);  // header and three iterations
  CHECK(table.find(",dem_steps,seconds,seconds_in_points,largest_gradient\n") != std::string::npos);
  CHECK(table.find(",64,2,1.5,0.01\n") != std::string::npos);  // in the words of the lines
}

TEST_CASE("a table that could share its second file with another one is refused before a file is made") {
  ScratchFolder const folder;
  for (char const* name : {"log.txt", "log.jsonl", "log"})
    CHECK_REFUSED(scarp::ConvergenceLog(folder / name, {}), "does not end in .csv", "name it .csv");
  CHECK(folder.file_count() == 0);
}

TEST_CASE("a resumed log goes on in both files, and a new one replaces both") {
  ScratchFolder const folder;
  auto const lines_after = [&](scarp::CsvStart start) {
    scarp::ConvergenceLog(folder / "convergence.csv", {2.0, "axial_strain"}, start)
        .attempted(NoProblem{}, two_iterations());
    auto const count = [&](char const* file) {
      std::string const text = content(folder / file);
      return std::count(text.begin(), text.end(), '\n');
    };
    return std::pair(count("convergence.csv"), count("convergence.jsonl"));
  };
  // A header and a row for each iteration; a line for each iteration and for the attempt.
  CHECK(lines_after(scarp::CsvStart::anew) == std::pair(3L, 3L));
  CHECK(lines_after(scarp::CsvStart::resumed) == std::pair(5L, 6L));
  CHECK(lines_after(scarp::CsvStart::anew) == std::pair(3L, 3L));
}

TEST_CASE("the slowest points are those with the most work, equal ones by number") {
  scarp::PointSurvey survey;
  int point = 0;
  for (long const work : {20, 30, 20, 500, 20, 40, 20, 0, 30}) survey.add(point++, scarp::Status::ok, work);
  std::vector<scarp::PointSurvey::Work> const expected{{3, 500}, {5, 40}, {1, 30}, {8, 30}, {0, 20}};
  CHECK(survey.slowest == expected);
  CHECK(survey.count(scarp::Status::ok) == 9);
}

TEST_CASE("text in JSON keeps to one line and its quotes") {
  CHECK(scarp::JsonObject().add("a \"name\"", "C:\\x\n").text() == R"({"a \"name\"":"C:\\x\u000a"})");
}

TEST_CASE("a step of a problem with parts tells the residual of each") {
  ScratchFolder const folder;
  scarp::ConvergenceLog log(folder / "convergence.csv", {2.0, "axial_strain"});
  auto report = two_iterations();
  report.parts = {{"all", 0.125}, {"a \"light\" footing", 0.0625}};
  log.attempted(NoProblem{}, report);
  CHECK(content(folder / "convergence.jsonl").find(R"("residuals":{"all":0.125,"a \"light\" footing":0.0625})") !=
        std::string::npos);
}
