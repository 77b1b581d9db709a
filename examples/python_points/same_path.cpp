// SPDX-License-Identifier: BSL-1.0
// same_path POINTS PATH STRESSES THREADS: points of MaterialPoints.save respond to the displacement gradients of a path
// again, in C++.
// PATH: for each response 1 where a commit follows, else 0, then the gradients of all points, rows first; STRESSES: of
// all responses.
// Numbers of double precision without anything between them.
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>

#include "points.hpp"

int main(int argc, char** argv) try {
  if (argc != 5)
    scarp::reject("there are {} words (four are needed): same_path POINTS PATH STRESSES THREADS", argc - 1);
  std::string const saved = scarp::read_file(argv[1]);
  scarp::StateReader reader(scarp::detail::payload_of(python_points::points_format, saved));
  int dimensions = 0;
  reader("dimensions", dimensions);
  if (dimensions != 2) scarp::reject("'{}' holds points in space (a path is plane): save others", argv[1]);
  auto const points = python_points::Points<2>::read(reader);
  std::string const path = scarp::read_file(argv[2]);
  std::size_t const count = static_cast<std::size_t>(points->now().size());
  std::size_t const row = 1 + 4 * count;
  std::vector<double> numbers(path.size() / sizeof(double));
  std::memcpy(numbers.data(), path.data(), numbers.size() * sizeof(double));
  if (numbers.size() % row != 0)
    scarp::reject("'{}' has {} numbers (rows of {} are expected): write it anew", argv[2], numbers.size(), row);

  std::string stresses;
  auto const start = std::chrono::steady_clock::now();
  for (std::size_t at = 0; at < numbers.size(); at += row) {
    for (std::size_t k = 0; k < count; ++k) {
      double const* const rows = &numbers[at + 1 + 4 * k];
      points->now().gradient(static_cast<int>(k)) = scarp::Gradient<2>{{rows[0], rows[1]}, {rows[2], rows[3]}};
    }
    points->at_work(std::stoi(argv[4]), [&](auto& all, auto& executor) { return all.respond(executor); });
    for (auto const& stress : points->now().stresses())
      stresses.append(reinterpret_cast<char const*>(stress.data()), sizeof(stress));
    if (numbers[at] == 1.0) points->commit();
  }
  std::chrono::duration<double> const seconds = std::chrono::steady_clock::now() - start;
  scarp::write_file(argv[3], stresses);
  std::printf("%.6f\n", seconds.count());
  return 0;
} catch (std::exception const& problem) {
  std::fprintf(stderr, "same_path: %s\n", problem.what());
  return 1;
}
