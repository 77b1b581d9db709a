// SPDX-License-Identifier: BSL-1.0
// Damaged files against every reader: it returns something sound or throws InputError or FileError with a message, soon and
// within bounded memory. fuzz_readers --seed S [--inputs N | --seconds T] [--only READER] [--first K]; docs/adversary.md
#include <fstream>

#include "adversary/contest.hpp"
#include "adversary/damage.hpp"
#include "io/mesh_samples.hpp"
#include "io/scratch_folder.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/contact/rolling_resistance.hpp"
#include "scarp/dem/time_stepping.hpp"
#include "scarp/io/checkpoint_files.hpp"
#include "scarp/io/gmsh/gmsh_reader.hpp"
#include "scarp/io/gmsh/gmsh_writer.hpp"
#include "scarp/io/mesh_tables.hpp"
#include "scarp/io/packings/contact_reader.hpp"
#include "scarp/io/packings/packing_file.hpp"
#include "scarp/mesh/mesh_checks.hpp"
#include "scarp/run/run_folder.hpp"
#include "scarp/shape/ellipse.hpp"
#include "scarp/shape/sphere.hpp"
#ifdef ADVERSARY_CONFIGURATION
#include "adversary/configuration.hpp"
#endif

namespace {

using adversary::below;
using adversary::demand;
using adversary::Game;
using adversary::Outcome;
using scarp::InputError;
using scarp::Random;
using scarp::Tensor;

using Ellipses = scarp::Packing<scarp::Ellipse, scarp::RollingResistance<scarp::LinearFrictional>>;
using Spheres = scarp::Packing<scarp::Sphere, scarp::LinearFrictional>;

scarp::LinearFrictional const springs{.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.5};
template <class P>
typename P::Law law_of() {
  if constexpr (std::same_as<typename P::Law, scarp::LinearFrictional>) {
    return springs;
  } else {
    return {.law = springs, .rolling_stiffness = 10.0, .rolling_friction = 0.1};
  }
}

/// "Problem (why): suggestion."
void check_message(std::string_view said) {
  bool const whole = said.find('(') < said.rfind("): ") && said.rfind("): ") + 5 < said.size();
  demand(whole, fmt::format("a refusal that says '{}'", said));
}

/// A reader with valid files; use(bytes) reads and checks what comes of it.
Game reader(std::string name, std::vector<std::string> samples, std::function<void(std::string const&)> use,
            std::function<void(std::string&, Random&)> mend = {}) {
  return {std::move(name), [=](Random& random) {
            auto bytes = adversary::Damage(samples, random).file();
            if (mend) mend(bytes, random);
            try {
              use(bytes);
              return Outcome::accepted;
            } catch (InputError const& refusal) {
              check_message(refusal.what());
            } catch (scarp::FileError const& refusal) {
              check_message(refusal.what());
            }
            return Outcome::refused;
          }};
}

template <class Element>
Game gmsh_reader(std::string const& name) {
  std::vector<std::string> samples;
  ScratchFolder const folder;
  auto const mesh = samples::mesh_sample<Element>(samples::bent);
  for (auto const version : {scarp::GmshVersion::v2_2, scarp::GmshVersion::v4_1}) {
    for (auto const encoding : {scarp::GmshEncoding::text, scarp::GmshEncoding::binary}) {
      scarp::write_gmsh(folder / "m.msh", mesh, {version, encoding});
      samples.push_back(content(folder / "m.msh"));
    }
  }
  return reader("gmsh " + name, samples, [](std::string const& bytes) {
    auto const read = scarp::detail::assemble_gmsh<Element>(scarp::detail::read_gmsh_content(bytes, "m.msh"));
    try {
      scarp::validate(read);
    } catch (InputError const& why) {
      demand(false, fmt::format("what was read is no valid mesh: {}", why.what()));
    }
    demand(std::isfinite(samples::volume(read)) && samples::volume(read) > 0.0, "a mesh without a volume");
    scarp::require_no_duplicate_nodes(read);
    scarp::require_no_hanging_nodes(read);
  });
}

std::vector<std::string> table_samples() {
  ScratchFolder const folder;
  scarp::write_mesh_tables(folder.path(), samples::mesh_sample<scarp::Quad4>(samples::sheared));
  scarp::CsvTable table({"name", "a \"quoted\" one", "value"});
  table.add("x, y", "two\nlines", 1.5);
  table.add("", "\"", -2e-300);
  table.write(folder / "own.csv");
  return {content(folder / "nodes.csv"), content(folder / "elements.csv"), content(folder / "boundaries.csv"),
          content(folder / "own.csv"), "# a b c\n1 2 3\n\t4 5.5 6\n# remark\n7 8 9\n"};
}

void use_table(std::string const& bytes, scarp::CsvSeparator separator) {
  scarp::CsvColumns const table(bytes, "t.csv", separator);
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

/// Grains of 4 to 6 mm on a jittered grid, touching here and there.
std::string grain_table(int dim, std::uint64_t seed) {
  Random random(seed);
  std::string text = "id,x,y,z,r,a,b,angle\n";
  for (int i = 0; i < 16; ++i) {
    double const size = random.uniform(4e-3, 6e-3);
    auto const at = [&](int step) { return 9e-3 * (step + random.uniform(-0.05, 0.05)); };
    text += fmt::format("{},{},{},{},{},{},{},{}\n", 3 * i, at(i % 4), at(i / 4 % (dim == 2 ? 4 : 2)),
                        dim == 2 ? 0.0 : at(i / 8), size, size, 0.75 * size, random.uniform(0.0, 3.0));
  }
  return text;
}

template <class P>
Tensor<P::dim> cell_of_grains() {
  scarp::Vector<P::dim> sides = scarp::Vector<P::dim>::Constant(4 * 9e-3);
  return sides.asDiagonal().toDenseMatrix();
}

template <class P>
scarp::NamedPacking<P> read_grains(std::string const& text) {
  return scarp::read_packing<P>(scarp::CsvColumns(text, "g.csv"), cell_of_grains<P>(), 2650.0, P::dim == 2 ? 0.2 : 1.0);
}

/// Steps of what was read end as a verdict.
template <class P>
void use_packing(P packing) {
  demand(packing.population != nullptr && packing.grain_count() == packing.population->count(),
         "grains without a size");
  demand(packing.population->smallest_radius() > 0.0, "a grain without a size");
  scarp::TimeStepper<P> stepper;
  Tensor<P::dim> strain = Tensor<P::dim>::Zero();
  strain(0, 1) = 1e-5;
  for (int k = 0; k < 3; ++k) {
    if (!stepper.step(packing, law_of<P>(), strain).acceptable()) return;
  }
}

template <class P>
Game grain_reader(std::string const& name) {
  return reader(name, {grain_table(P::dim, 1), grain_table(P::dim, 2)}, [](std::string const& bytes) {
    auto const named = read_grains<P>(bytes);
    for (std::size_t i = 0; i < named.packing.grain_count(); ++i) {
      for (double const x : named.packing.position.row(i)) demand(std::isfinite(x), "a place that is not finite");
      for (double const size : named.packing.population->size(i)) demand(size > 0.0, "a grain without a size");
      demand(std::isfinite(named.packing.population->inverse_mass()[i]), "a grain without mass");
    }
    use_packing(named.packing);
  });
}

Game contact_reader() {
  auto const grains = read_grains<Spheres>(grain_table(3, 1));
  std::string text = "id1,id2,cell_i,cell_j,cell_k,ftx,fty,ftz,overlap\n";
  auto listed = grains.packing;
  demand(scarp::TimeStepper<Spheres>{}.refresh(listed, springs).acceptable(), "the sample has no list");
  scarp::for_each_near_pair(listed, springs, [&](auto const& contact) {
    auto const place = [&](std::size_t i) { return Eigen::Vector3d(grains.packing.position.row(i).data()); };
    scarp::Vector<3> const apart = contact.branch - (place(contact.second) - place(contact.first));
    Eigen::Vector3d const cells = grains.packing.cell.inverse() * apart;
    text += fmt::format("{},{},{},{},{},{},{},{},{}\n", grains.ids[contact.first], grains.ids[contact.second],
                        std::lround(cells(0)), std::lround(cells(1)), std::lround(cells(2)), 0.1, -0.2, 0.3,
                        contact.touch.overlap);
  });
  return reader("contacts", {text}, [grains](std::string const& bytes) {
    auto named = grains;
    scarp::read_contacts(named, scarp::CsvColumns(bytes, "c.csv"), springs);
    for (std::size_t p = 0; p < named.packing.pairs.count(); ++p) {
      for (double const force : named.packing.pairs.shear.row(p))
        demand(std::isfinite(force), "a force that is not finite");
    }
    use_packing(named.packing);
  });
}

/// Length and hash of a damaged file as if it had been written so: only what is behind them can refuse it then.
void mend_frame(std::string& bytes, Random& random) {
  constexpr std::size_t head = 24;
  if (bytes.size() < head + 8 || below(random, 5) == 0) return;
  std::uint64_t const length = bytes.size() - head - 8;
  std::memcpy(bytes.data() + 16, &length, 8);
  std::uint64_t const hash = scarp::detail::hash_of(std::string_view(bytes).substr(0, bytes.size() - 8));
  std::memcpy(bytes.data() + bytes.size() - 8, &hash, 8);
}

/// In a list of pairs and with something to remember.
template <class P>
P sheared_sample() {
  P packing = read_grains<P>(grain_table(P::dim, 1)).packing;
  scarp::TimeStepper<P> stepper;
  Tensor<P::dim> strain = -1e-4 * Tensor<P::dim>::Identity();
  for (int k = 0; k < 20; ++k)
    demand(stepper.step(packing, law_of<P>(), strain).acceptable(), "the sample does not step");
  return packing;
}

template <class P>
Game packing_reader(std::string const& name) {
  ScratchFolder const folder;
  scarp::save_packing(folder / "p", sheared_sample<P>());
  scarp::save_packing(folder / "q", read_grains<P>(grain_table(P::dim, 2)).packing);
  return reader(
      name, {content(folder / "p"), content(folder / "q")},
      [](std::string const& bytes) { use_packing(scarp::detail::packing_of<P>(bytes)); }, mend_frame);
}

/// One member of each kind that a saved state may have.
struct Saved {
  std::vector<Ellipses> packings;
  std::vector<std::string> names;
  std::vector<std::pair<double, scarp::Verdict>> pairs;
  std::array<double, 3> three{};
  scarp::Vector<2> vector = scarp::Vector<2>::Zero();
  bool flag = true;
  int count = 3;
  SCARP_MEMBERS(packings, names, pairs, three, vector, flag, count)
};

Game checkpoint_reader() {
  auto const folder = std::make_shared<ScratchFolder>();
  std::string const scene = "size = 2.5\nseed = 1\n";
  auto const packing = sheared_sample<Ellipses>();
  Saved const saved{{packing, packing}, {"one", ""}, {{1.0, {}}, {2.0, {}}}, {}, {}, true, 3};
  scarp::CheckpointFiles files({.folder = folder->path() / "made"}, scene);
  files.name_run("run", "folder");
  files.save([&](scarp::StateWriter& writer) { writer("saved", saved); });
  auto const bytes = content(files.newest());
  std::filesystem::create_directory(*folder / "damaged");
  return reader(
      "checkpoints", {bytes},
      [=](std::string const& damaged) {
        std::ofstream(*folder / "damaged" / "checkpoint_000007", std::ios::binary) << damaged;
        scarp::CheckpointFiles const there({.folder = *folder / "damaged", .resume = true}, scene);
        Saved state;
        there.load([&](scarp::StateReader& reader) { reader("saved", state); });
        for (auto const& one : state.packings) use_packing(one);
      },
      mend_frame);
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

int main(int count, char** words) {
  using scarp::CsvSeparator;
  std::vector<Game> games{
      gmsh_reader<scarp::Tri3>("Tri3"),
      gmsh_reader<scarp::Quad8>("Quad8"),
      gmsh_reader<scarp::Tet10>("Tet10"),
      gmsh_reader<scarp::Hex8>("Hex8"),
      reader("tables", table_samples(), [](std::string const& bytes) { use_table(bytes, CsvSeparator::comma); }),
      reader("tables of blanks", table_samples(),
             [](std::string const& bytes) { use_table(bytes, CsvSeparator::blanks); }),
      grain_reader<Ellipses>("ellipses"),
      grain_reader<Spheres>("spheres"),
      contact_reader(),
      packing_reader<Ellipses>("packings of ellipses"),
      packing_reader<Spheres>("packings of spheres"),
      checkpoint_reader(),
      record_reader()};
#ifdef ADVERSARY_CONFIGURATION
  games.push_back(adversary::configuration_reader());
#endif
  return adversary::contest(count, words, games);
}
