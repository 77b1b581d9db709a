// SPDX-License-Identifier: BSL-1.0
#include <deal.II/distributed/grid_refinement.h>
#include <deal.II/distributed/solution_transfer.h>
#include <deal.II/numerics/data_out.h>

#include <boost/serialization/utility.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "ground.hpp"
#include "scarp/fault/rupture_measures.hpp"

namespace dealii_fault {

using Transfer = dealii::parallel::distributed::SolutionTransfer<2, Vector>;

/// Cells that have sheared since the last refinement are to be divided, those that have not are to be joined.
/// \return whether there are any
bool Ground::mark() {
  effort_of_cell_.assign(mesh_.n_active_cells(), 0.0);
  std::size_t first = 0;
  for (auto const& cell : mesh_.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    double shear = 0.0;
    for (std::size_t p = first; p < first + cell_points; ++p) {
      shear = std::max(shear, history_[p].shear);
      effort_of_cell_[cell->active_cell_index()] += history_[p].effort;
    }
    first += cell_points;
    if (shear > options_.refine_at && cell->level() < options_.levels) cell->set_refine_flag();
    if (shear < 0.1 * options_.refine_at && cell->level() > 0) cell->set_coarsen_flag();
  }
  mesh_.prepare_coarsening_and_refinement();
  int marked = 0;
  for (auto const& cell : mesh_.active_cell_iterators())
    marked += cell->is_locally_owned() && (cell->refine_flag_set() || cell->coarsen_flag_set());
  return mpi::sum(marked, comm_) > 0;
}

void Ground::adapt() {
  if (!mark()) return;
  auto const tell = [&](char const* when) {
    out_ << when << ": " << mesh_.n_global_active_cells() << " cells, reaction " << reaction() << " N, internal work "
         << work_ << " J, residual " << residual_ << "\n";
  };
  evaluate(zero(), false);
  tell("before refinement");
  Points const points = std::move(points_);
  Sites const sites(sites_.begin(), sites_.begin() + static_cast<std::ptrdiff_t>(own()));
  auto const histories = history_;
  Vector const now = ghosted(moved_), rest = ghosted(rest_);
  Transfer transfer(dofs_);
  transfer.prepare_for_coarsening_and_refinement({&now, &rest});
  mesh_.execute_coarsening_and_refinement();
  build();
  std::vector<Vector*> const vectors{&moved_, &rest_};
  transfer.interpolate(const_cast<std::vector<Vector*>&>(vectors));
  for (auto* vector : vectors) hanging_.distribute(*vector);
  last_throw_ = 0.0;
  start_from(moved_);
  carry(points, sites, histories);
  for (auto& of : history_) of.shear = 0.0;
  evaluate(zero(), false);
  tell("after refinement");
  auto const verdict = step(0.0);
  out_ << "balanced anew (" << name(verdict.reason) << ") ";
  tell("");
}

/// Gives every own point the state of the nearest of some points that are shared out otherwise; only states that leave a process are
/// sent. sites, histories: of these points that this process has
void Ground::carry(Points const& from, Sites const& sites, std::vector<History> const& histories) {
  std::map<unsigned, std::vector<std::array<double, 5>>> offered;
  for (auto const& [rank, numbers] : reached(sites, 4.0 * options_.size)) {
    for (int const k : numbers) {
      auto const& [shear, effort] = histories[static_cast<std::size_t>(k)];
      auto const& at = sites[static_cast<std::size_t>(k)].position;
      offered[rank].push_back({1.0 * k, at.x(), at.y(), shear, effort});
    }
  }
  auto const offers = mpi::some_to_some(comm_, offered);
  std::map<unsigned, std::map<int, std::vector<int>>> takers;  // own points, by process and number there
  for (std::size_t k = 0; k < own(); ++k) {
    double nearest = std::numeric_limits<double>::infinity();
    unsigned holder = 0;
    int number = -1;
    for (auto const& [rank, places] : offers) {
      for (auto const& [there, x, y, shear, effort] : places) {
        double const distance = (sites_[k].position - scarp::Vector<2>(x, y)).squaredNorm();
        if (distance >= nearest) continue;
        nearest = distance, holder = rank, number = static_cast<int>(there);
        history_[k] = {shear, effort};
      }
    }
    takers[holder][number].push_back(static_cast<int>(k));
  }
  unsigned const me = mpi::this_mpi_process(comm_);
  Numbers wanted;
  for (auto const& [rank, numbers] : takers) {
    for (auto const& [number, points] : numbers) {
      if (rank == me) points_.copy(points.front(), from, number);
      if (rank != me) wanted[rank].push_back(number);
    }
  }
  std::map<unsigned, std::string> sent;
  for (auto const& [rank, numbers] : mpi::some_to_some(comm_, wanted)) sent[rank] = from.pack(numbers);
  for (auto const& [rank, bits] : mpi::some_to_some(comm_, sent)) {
    std::vector<int> firsts;
    for (auto const& [number, points] : takers[rank]) firsts.push_back(points.front());
    points_.unpack(firsts, bits);
  }
  for (auto const& [rank, numbers] : takers) {
    for (auto const& [number, points] : numbers) {
      for (std::size_t k = 1; k < points.size(); ++k) points_.copy(points[k], points_, points.front(), k % 2 == 1);
    }
  }
}

/// What a saved run must share with the one that takes it up.
std::vector<double> Ground::identity() const {
  return {1.0 * options_.degree, options_.size,   static_cast<double>(options_.soil),
          1.0 * options_.grains, options_.length, options_.tip,
          options_.dip};
}

/// Mesh, displacements and one file of states for each process, in a folder that is there whole or not at all.
void Ground::save() {
  namespace fs = std::filesystem;
  fs::path const folder = options_.checkpoint, next = options_.checkpoint + ".new";
  unsigned const me = mpi::this_mpi_process(comm_);
  if (me == 0) fs::remove_all(next), fs::create_directories(next);
  MPI_Barrier(comm_);
  Vector const now = ghosted(moved_), rest = ghosted(rest_), last = ghosted(last_);
  Transfer transfer(dofs_);
  transfer.prepare_for_serialization({&now, &rest, &last});
  effort_of_cell_.assign(mesh_.n_active_cells(), 0.0);
  mesh_.save(next / "mesh");
  auto numbers = identity();
  for (double const value :
       {1.0 * mpi::n_mpi_processes(comm_), throw_, increment_, last_throw_, reaction_at_rest_, work_, 1.0 * steps_})
    numbers.push_back(value);
  std::vector<int> all;
  for (std::size_t k = 0; k < own(); ++k) {
    auto const& [number, region, at, depth] = sites_[k];
    for (double const value : {1.0 * number, at.x(), at.y(), depth, history_[k].effort, history_[k].shear})
      numbers.push_back(value);
    all.push_back(static_cast<int>(k));
  }
  auto const bytes = dealii::Utilities::pack(Saved(numbers, points_.pack(all)), false);
  std::ofstream file(next / ("points." + std::to_string(me)), std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (mpi::max(int(!file), comm_))
    scarp::reject("the run was not saved in '{}' (a file cannot be written): make room", next.string());
  if (me == 0) fs::remove_all(folder), fs::rename(next, folder);
  MPI_Barrier(comm_);
}

/// \throws scarp::InputError for a file that is missing or damaged, and that of another run
Ground::Saved Ground::saved(unsigned file) const {
  auto const path = std::filesystem::path(options_.checkpoint) / ("points." + std::to_string(file));
  std::ifstream stream(path, std::ios::binary);
  std::vector<char> const bytes{std::istreambuf_iterator<char>(stream), {}};
  Saved part;
  try {
    part = dealii::Utilities::unpack<Saved>(bytes, false);
  } catch (std::exception const&) {
    scarp::reject("'{}' is not the file of a saved run (missing or damaged): save it again with --checkpoint",
                  path.string());
  }
  auto const own = identity();
  if (!std::equal(own.begin(), own.end(), part.first.begin()))
    scarp::reject("'{}' was saved by another run (element, size, soil or length differ): resume with its options",
                  path.string());
  part.first.erase(part.first.begin(), part.first.begin() + std::ssize(own));
  return part;
}

/// On any number of processes.
void Ground::resume() {
  constexpr std::size_t header = 7, columns = 6;
  auto const first = saved(0).first;
  auto const files = static_cast<unsigned>(first[0]);
  build();  // makes the packings of the mesh that the run began with
  effort_of_cell_.assign(mesh_.n_active_cells(), 0.0);
  mesh_.load(std::filesystem::path(options_.checkpoint) / "mesh");
  build();
  std::vector<Vector*> vectors{&moved_, &rest_, &last_};
  Transfer(dofs_).deserialize(vectors);
  start_from(moved_);
  throw_ = first[1], increment_ = first[2], last_throw_ = first[3], reaction_at_rest_ = first[4], work_ = first[5];
  steps_ = static_cast<int>(first[6]);
  Sites sites;
  std::vector<History> histories;
  std::vector<std::pair<std::vector<int>, std::string>> parts;
  unsigned const processes = mpi::n_mpi_processes(comm_);
  for (unsigned file = mpi::this_mpi_process(comm_); file < files; file += processes) {
    auto const [numbers, bits] = saved(file);
    parts.emplace_back(std::vector<int>{}, bits);
    for (std::size_t k = header; k < numbers.size(); k += columns) {
      parts.back().first.push_back(static_cast<int>(sites.size()));
      auto const* const row = &numbers[k];
      sites.push_back({.index = static_cast<int>(row[0]), .position = {row[1], row[2]}, .depth = row[3]});
      histories.push_back({.shear = row[5], .effort = row[4]});
    }
  }
  int const count = static_cast<int>(sites.size());
  Points points = count == 0 ? Points() : maker_(sites, std::vector<double>(sites.size(), 1.0), count);
  for (auto const& [numbers, bits] : parts) points.unpack(numbers, bits);
  carry(points, sites, histories);
  evaluate(zero(), false);
  out_ << "resumed at " << throw_ << " m on " << processes << " processes, saved by " << files << ": reaction "
       << reaction() << " N, residual " << residual_ << "\n";
}

/// Where the fault comes out, what it takes, and what it cost.
void Ground::report(bool complete) {
  Vector const now = ghosted(moved_), rest = ghosted(rest_);
  std::map<double, std::array<double, 4>> mine;  // by place: displacements now and at rest
  for (unsigned axis = 0; axis < 2; ++axis) {
    for (auto const& [dof, place] : places(axis)) {
      if (std::abs(place[1] - ground_depth) < 1e-9)
        mine[place[0]][axis] = now(dof), mine[place[0]][axis + 2] = rest(dof);
    }
  }
  std::map<double, std::array<double, 4>> surface;
  for (auto const& part : mpi::all_gather(comm_, std::vector(mine.begin(), mine.end())))
    surface.insert(part.begin(), part.end());
  std::vector<scarp::SurfacePoint> profile;
  double missing = 0.0;
  for (auto const& [x, u] : surface) {
    profile.push_back({x + u[2], x + u[0], u[3] - u[1]});
    if (profile.size() == 1) continue;
    auto const& last = profile[profile.size() - 2];
    missing += (profile.back().x - last.x) * (profile.back().settlement + last.settlement) / 2.0;
  }
  scarp::FaultOffset const offset{.tip = options_.tip, .hanging = throw_};
  double const x50 = scarp::rupture_measures(profile, offset, ground_depth).surface_x50;
  double const mean = profile.back().x - missing / throw_;
  total_.stop();
  double const seconds = total_.wall_time(), points = in_points_.wall_time(), solver = in_solver_.wall_time();
  evaluate(zero(), false);
  auto const steps = mpi::sum(static_cast<double>(inner_steps_), comm_);
  out_ << "deal.II " << DEAL_II_PACKAGE_VERSION << ", " << mpi::n_mpi_processes(comm_) << " processes of "
       << executor_.threads() << " threads, Q" << options_.degree << ", " << mesh_.n_global_active_cells() << " cells, "
       << cell_points * mesh_.n_global_active_cells() << " points\n"
       << (complete ? "throw " : "INCOMPLETE: throw ") << throw_ << " m, x50 " << x50 << " m, profile mean " << mean
       << " m, reaction " << reaction() << " N, internal work " << work_ << " J\n";
  if (options_.own_x50) out_ << "x50 less that of scarp's own elements: " << x50 - *options_.own_x50 << " m\n";
  if (options_.own_mean)
    out_ << "profile mean less that of scarp's own elements: " << mean - *options_.own_mean << " m\n";
  out_ << steps_ << " steps, " << cuts_ << " cuts, " << iterations_ << " iterations, " << steps << " DEM steps\n"
       << seconds << " s: points " << 100.0 * points / seconds << " %, solver " << 100.0 * solver / seconds
       << " %, rest " << 100.0 * (1.0 - (points + solver) / seconds) << " %\n";
}

void Ground::draw() const {
  std::filesystem::create_directories(options_.output);
  Vector const now = ghosted(moved_);
  dealii::Vector<float> pressure(mesh_.n_active_cells()), process(mesh_.n_active_cells());
  int first = 0;
  for (auto const& cell : mesh_.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    for (int p = first; p < first + cell_points; ++p)
      pressure[cell->active_cell_index()] -=
          static_cast<float>(points_.committed_stress(p).head<2>().sum() / (2.0 * cell_points));
    process[cell->active_cell_index()] = static_cast<float>(mpi::this_mpi_process(comm_));
    first += cell_points;
  }
  dealii::DataOut<2> fields;
  using Kind = dealii::DataComponentInterpretation::DataComponentInterpretation;
  fields.add_data_vector(dofs_, now, std::vector<std::string>(2, "displacement"),
                         std::vector<Kind>(2, dealii::DataComponentInterpretation::component_is_part_of_vector));
  fields.add_data_vector(pressure, "pressure");
  fields.add_data_vector(process, "process");
  fields.build_patches();
  fields.write_vtu_with_pvtu_record(options_.output + "/", "ground", 0, comm_);
}

}  // namespace dealii_fault
