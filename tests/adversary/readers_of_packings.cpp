// SPDX-License-Identifier: BSL-1.0
#include <fstream>

#include "../../examples/shared/contact_reader.hpp"
#include "../../examples/shared/grain_files.hpp"
#include "adversary/readers.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/contact/rolling_resistance.hpp"
#include "scarp/dem/time_stepping.hpp"
#include "scarp/io/checkpoint_files.hpp"
#include "scarp/io/packings/packing_file.hpp"
#include "scarp/shape/ellipse.hpp"
#include "scarp/shape/sphere.hpp"

namespace adversary {

namespace {

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
    examples::read_contacts(named, scarp::CsvColumns(bytes, "c.csv"), springs);
    for (std::size_t p = 0; p < named.packing.pairs.count(); ++p) {
      for (double const force : named.packing.pairs.shear.row(p))
        demand(std::isfinite(force), "a force that is not finite");
    }
    use_packing(named.packing);
  });
}

/// The grains of a table in the forms of other codes.
std::vector<std::string> other_codes(std::string const& text) {
  scarp::CsvColumns const table(text, "g.csv");
  std::string yade = "##PERIODIC:: 0.036 0.036 0.036\n";
  std::string data =
      "spheres\n\n0 0.036 xlo xhi\n0 0.036 ylo yhi\n0 0.036 zlo zhi\n0 0 0 xy xz yz\n\nAtoms # sphere\n\n";
  std::string dump =
      "ITEM: BOX BOUNDS xy xz yz pp pp pp\n0 0.036 0\n0 0.036 0\n0 0.036 0\nITEM: ATOMS id x y z radius\n";
  std::string mercury = fmt::format(
      "MercuryDPM 1.0\nxMin 0 xMax 0.036 yMin 0 yMax 0.036 zMin 0 zMax 0.036\nParticles {}\n", table.rows());
  auto const [x, y, z, r] = std::array{table.column("x"), table.column("y"), table.column("z"), table.column("r")};
  for (std::size_t i = 0; i < x.size(); ++i) {
    yade += fmt::format("{} {} {} {}\n", x[i], y[i], z[i], r[i]);
    data += fmt::format("{} 1 {} 2650 {} {} {}\n", i, 2 * r[i], x[i], y[i], z[i]);
    dump += fmt::format("{} {} {} {} {}\n", i, x[i], y[i], z[i], r[i]);
    mercury += fmt::format("SphericalParticle id {} position {} {} {} radius {}\n", i, x[i], y[i], z[i], r[i]);
  }
  return {yade, data, dump, mercury};
}

Game other_codes_reader() {
  auto const folder = std::make_shared<ScratchFolder>();
  return reader("grains of other codes", other_codes(grain_table(3, 1)), [folder](std::string const& bytes) {
    std::ofstream(*folder / "g", std::ios::binary) << bytes;
    auto const file = examples::read_grains(*folder / "g");
    if (!file.cell) return;
    use_packing(scarp::read_packing<Spheres>(file.grains, *file.cell, 2650.0, 1.0).packing);
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

}  // namespace

std::vector<Game> readers_of_packings() {
  return {grain_reader<Ellipses>("ellipses"),
          grain_reader<Spheres>("spheres"),
          contact_reader(),
          other_codes_reader(),
          packing_reader<Ellipses>("packings of ellipses"),
          packing_reader<Spheres>("packings of spheres"),
          checkpoint_reader()};
}

}  // namespace adversary
