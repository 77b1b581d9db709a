// SPDX-License-Identifier: BSL-1.0
#include <fstream>

#include "adversary/readers.hpp"
#include "scarp/io/csv.hpp"
#include "scarp/io/csv_reader.hpp"
#include "scarp/run/run_folder.hpp"

namespace adversary {

namespace {

std::vector<std::string> table_samples() {
  ScratchFolder const folder;
  scarp::CsvTable nodes({"node", "x", "y"});
  for (int n = 0; n < 10; ++n) nodes.add(n, 0.1 * n, 0.3 - 1e-3 * n);
  nodes.write(folder / "nodes.csv");
  scarp::CsvTable elements({"element", "region", "n0", "n1", "n2", "n3"});
  for (int e = 0; e < 4; ++e) elements.add(e, e % 2 == 0 ? "lower sand" : "upper", e, e + 1, e + 6, e + 5);
  elements.write(folder / "elements.csv");
  scarp::CsvTable table({"name", "a \"quoted\" one", "value"});
  table.add("x, y", "two\nlines", 1.5);
  table.add("", "\"", -2e-300);
  table.write(folder / "own.csv");
  return {content(folder / "nodes.csv"), content(folder / "elements.csv"), content(folder / "own.csv"),
          "sep=;\na;b;\n1;2;\n;;\n\"3\";4\n"};
}

void use_table(std::string const& bytes) {
  scarp::CsvColumns const table(bytes, "t.csv");
  for (auto const& name : table.names()) {
    try {
      auto const values = table.column(name);
      demand(values.size() == table.rows(), "a column of another length");
      for (double const value : values) demand(std::isfinite(value), "a number that is not finite");
    } catch (InputError const&) {
    }
    try {
      static_cast<void>(table.column<std::int64_t>(name));
      static_cast<void>(table.column<int>(name));
    } catch (InputError const&) {
    }
  }
}

Game record_reader() {
  scarp::RunRecord const record{.program = "a program",
                                .identity = "2026-01-01-1",
                                .state = "running",
                                .started = "then",
                                .changed = "now",
                                .checkpoint = "/a/\"quoted\"\\folder",
                                .scene = "size = 1\nseed = 2\n",
                                .build = {{"version", "1"}},
                                .options = {{"size", "1"}, {"name", "\x01\t{}"}}};
  auto const folder = std::make_shared<ScratchFolder>();
  return reader("run records", {record.text()}, [=](std::string const& bytes) {
    auto const read = scarp::RunRecord::from(bytes);
    demand(scarp::RunRecord::from(read.text()).text() == read.text(), "a record that is another one when written");
    std::ofstream(*folder / "run.json", std::ios::binary) << bytes;
    try {
      scarp::RunFolder(scarp::RunFolderSettings{.folder = folder->path()}, scarp::RunRecord{.program = "another"});
      demand(false, "another run's folder was given away");
    } catch (scarp::FolderError const& refusal) {
      check_message(refusal.what());
    }
  });
}

}  // namespace

std::vector<Game> readers_of_tables() { return {reader("tables", table_samples(), use_table), record_reader()}; }

}  // namespace adversary
