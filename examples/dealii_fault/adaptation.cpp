// SPDX-License-Identifier: BSL-1.0
#include <deal.II/distributed/solution_transfer.h>

#include <boost/serialization/utility.hpp>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>

#include "ground.hpp"
#include "scarp/io/atomic_file.hpp"
#include "scarp/io/framed_file.hpp"
#include "scarp/io/read_file.hpp"

namespace dealii_fault {

using Transfer = dealii::parallel::distributed::SolutionTransfer<2, Vector>;
using dealii::Utilities::pack;
using dealii::Utilities::unpack;
namespace fs = std::filesystem;

namespace {

std::array<int, cell_points> points_from(std::size_t first) {
  std::array<int, cell_points> numbers;
  std::iota(numbers.begin(), numbers.end(), static_cast<int>(first));
  return numbers;
}

/// Of the text and of the forest's files.
std::uint64_t fingerprint(fs::path const& folder, std::string text) {
  std::map<std::string, fs::path> files;
  for (auto const& entry : fs::directory_iterator(folder)) files[entry.path().filename().string()] = entry.path();
  files.erase("run");
  for (auto const& [name, path] : files) {
    auto const bytes = scarp::read_file(path);
    text += fmt::format("{} {} {}\n", name, bytes.size(), scarp::detail::hash_of(bytes));
  }
  return scarp::detail::hash_of(text);
}

}  // namespace

/// Cells that have sheared since the mesh last changed are to be divided, those that have not are to be joined.
/// \return whether there are any
bool Ground::mark() {
  int marked = 0;
  for (auto const& cell : mesh_.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    double shear = 0.0;
    for (int const p : points_from(first_point(cell)))
      shear = std::max(shear, history_[static_cast<std::size_t>(p)].shear);
    if (shear > options_.refine_at && cell->level() < options_.levels) cell->set_refine_flag();
    bool const is_kept = is_at_tip(cell->vertex(0)) || is_at_tip(cell->vertex(1));
    if (shear < options_.refine_at / 10.0 && cell->level() > 0 && !is_kept) cell->set_coarsen_flag();
  }
  mesh_.prepare_coarsening_and_refinement();
  for (auto const& cell : mesh_.active_cell_iterators())
    marked += cell->is_locally_owned() && (cell->refine_flag_set() || cell->coarsen_flag_set());
  return mpi::sum(marked, comm_) > 0;
}

/// Divides and joins cells, and shares points out anew where these change or processes have unequal DEM steps.
/// Point p of a cell and child p of it lie in one corner: a child's points begin as copies of the one, and this as the
/// child's outermost.
void Ground::adapt() {
  double effort = 0.0;
  for (auto const& of : history_) effort += of.effort;
  auto const efforts = mpi::min_max_avg(effort, comm_);
  bool const changes = mark();
  if (!changes && efforts.max <= options_.imbalance * efforts.avg) return;
  auto const print = [&](char const* when) {
    out_ << when << " refinement: " << mesh_.n_global_active_cells() << " cells, reaction " << reaction()
         << " N, internal work " << work_ << " J, residual " << residual_ << "\n";
  };
  if (changes) static_cast<void>(evaluate(zero(), false)), print("before");
  Vector const now(ghosted(moved_)), rest(ghosted(rest_)), last(ghosted(last_));
  Transfer transfer(dofs_);
  transfer.prepare_for_coarsening_and_refinement({&now, &rest, &last});
  using Origins = std::array<Origin, cell_points>;
  auto const handle = mesh_.register_data_attach(
      [&](Mesh::cell_iterator const& cell, auto const status) {
        Origins from;
        for (unsigned p = 0; p < cell_points; ++p) {
          auto const k = first_point(status == Mesh::CELL_COARSEN ? cell->child(p) : cell) + p;
          from[p] = {mpi::this_mpi_process(comm_), static_cast<int>(k), history_[k]};
        }
        return pack(from, false);
      },
      false);
  Points const points = std::move(points_);
  mesh_.execute_coarsening_and_refinement();
  build();
  std::vector<Vector*> vectors{&moved_, &rest_, &last_};
  transfer.interpolate(vectors);
  for (auto* vector : vectors) hanging_.distribute(*vector);
  std::vector<Origin> origins(history_.size());
  mesh_.notify_ready_to_unpack(handle, [&](Mesh::cell_iterator const& cell, auto const status, auto const& bits) {
    auto const from = unpack<Origins>(bits.begin(), bits.end(), false);
    for (unsigned p = 0; p < cell_points; ++p) {
      if (status != Mesh::CELL_REFINE) origins[first_point(cell) + p] = from[p];
      for (unsigned q = 0; q < cell_points && status == Mesh::CELL_REFINE; ++q)
        origins[first_point(cell->child(p)) + q] = from[p];
    }
  });
  ++adaptations_;
  start_from_moved();
  carry(points, origins);
  if (!changes) return;
  last_throw_ = 0.0;
  for (auto& of : history_) of.shear = 0.0;
  static_cast<void>(evaluate(zero(), false));
  print("after");
  auto const verdict = step(0.0);
  out_ << "balanced anew (" << name(verdict.reason) << ") after";
  print("");
}

/// Gives every own point the state of a point before; only states that leave a process are sent. Every second copy is
/// mirrored.
void Ground::carry(Points const& from, std::vector<Origin> const& origins) {
  std::map<unsigned, std::map<int, std::vector<int>>> takers;  // own points, by process and number there
  for (std::size_t k = 0; k < origins.size(); ++k) {
    history_[k] = origins[k].history;
    takers[origins[k].process][origins[k].point].push_back(static_cast<int>(k));
  }
  std::map<unsigned, std::vector<int>> wanted, firsts;
  for (auto const& [rank, numbers] : takers) {
    for (auto const& [number, points] : numbers) {
      if (rank == mpi::this_mpi_process(comm_)) {
        points_.copy(points.front(), from, number);
      } else {
        wanted[rank].push_back(number);
        firsts[rank].push_back(points.front());
      }
    }
  }
  std::map<unsigned, std::string> sent;
  for (auto const& [rank, numbers] : mpi::some_to_some(comm_, wanted)) {
    sent[rank] = from.pack(numbers);
    ++state_messages_;
    moved_states_ += std::ssize(numbers);
    moved_bytes_ += std::ssize(sent[rank]);
  }
  for (auto const& [rank, bits] : mpi::some_to_some(comm_, sent)) points_.unpack(firsts[rank], bits);
  for (auto const& [rank, numbers] : takers) {
    for (auto const& [number, points] : numbers) {
      for (std::size_t k = 1; k < points.size(); ++k) points_.copy(points[k], points_, points.front(), k % 2 == 1);
    }
  }
}

/// What a saved run must share with the one that takes it up.
std::string Ground::identity() const {
  return fmt::format("size {}, levels {}, soil {}, grains {}, length {}, tip {}, dip {}", options_.size,
                     options_.levels, static_cast<int>(options_.soil), options_.grains, options_.length, options_.tip,
                     options_.dip);
}

/// Mesh, displacements and states in the files of the forest, with a file of numbers, written last. The run saved
/// before goes when this one is whole.
void Ground::save() {
  fs::path const folder = options_.checkpoint, next = options_.checkpoint + ".new",
                 before = options_.checkpoint + ".old";
  bool const is_root = mpi::this_mpi_process(comm_) == 0;
  if (is_root) fs::remove_all(next), fs::remove_all(before), fs::create_directories(next);
  MPI_Barrier(comm_);
  Vector const now(ghosted(moved_)), rest(ghosted(rest_)), last(ghosted(last_));
  Transfer transfer(dofs_);
  transfer.prepare_for_serialization({&now, &rest, &last});
  mesh_.register_data_attach(
      [&](Mesh::cell_iterator const& cell, auto) {
        auto const first = first_point(cell);
        std::vector<double> values;
        for (std::size_t k = first; k < first + cell_points; ++k)
          values.insert(values.end(), {history_[k].shear, history_[k].effort});
        return pack(std::pair(values, points_.pack(points_from(first))), false);
      },
      true);
  mesh_.save(next / "mesh");
  if (is_root) {
    auto const text = fmt::format("{}\n{} {} {} {} {} {} {}\n", identity(), mpi::n_mpi_processes(comm_), throw_,
                                  increment_, last_throw_, reaction_at_rest_, work_, steps_);
    scarp::write_file(next / "run", text + fmt::format("{}\n", fingerprint(next, text)));
    if (fs::exists(folder)) fs::rename(folder, before);  // whole at any time, as resume() expects it
    fs::rename(next, folder), fs::remove_all(before);
  }
  MPI_Barrier(comm_);
  saved_at_ = mpi::max(total_.wall_time(), comm_);
}

/// On any number of processes.
/// \throws scarp::InputError for a folder without a saved run, one with changed files, and that of another run
void Ground::resume() {
  fs::path const folder = options_.checkpoint, next = options_.checkpoint + ".new";
  bool const is_root = mpi::this_mpi_process(comm_) == 0;
  if (is_root && !fs::exists(folder) && fs::exists(next / "run")) fs::rename(next, folder);  // save() was killed before
  MPI_Barrier(comm_);
  std::ifstream file(folder / "run");
  std::string found, numbers;
  std::getline(file, found), std::getline(file, numbers);
  unsigned writers = 0;
  std::uint64_t print = 0;
  std::istringstream(numbers) >> writers >> throw_ >> increment_ >> last_throw_ >> reaction_at_rest_ >> work_ >> steps_;
  if (!(file >> print))
    scarp::reject("'{}' is not the folder of a saved run (missing or damaged): save it again with --checkpoint",
                  folder.string());
  if (print != fingerprint(folder, found + "\n" + numbers + "\n"))
    scarp::reject("the run saved in '{}' is damaged (its files are not those that were written): use a copy of it",
                  folder.string());
  MPI_Barrier(comm_);  // all have read before any begins
  if (found != identity())
    scarp::reject("'{}' was saved by another run ({}): resume with its options", folder.string(), found);
  divide_tip();
  build();  // makes the packings of the mesh that the run began with
  history_.clear();
  while (mesh_.n_global_levels() > 1) {
    for (auto const& cell : mesh_.active_cell_iterators())
      if (cell->is_locally_owned() && cell->level() > 0) cell->set_coarsen_flag();
    mesh_.execute_coarsening_and_refinement();
  }
  mesh_.load(folder / "mesh");
  build();
  std::vector<Vector*> vectors{&moved_, &rest_, &last_};
  Transfer(dofs_).deserialize(vectors);
  auto const handle = mesh_.register_data_attach([](auto const&, auto) { return std::vector<char>(); }, true);
  mesh_.notify_ready_to_unpack(handle, [&](Mesh::cell_iterator const& cell, auto, auto const& bits) {
    auto const [values, states] = unpack<std::pair<std::vector<double>, std::string>>(bits.begin(), bits.end(), false);
    auto const first = first_point(cell);
    points_.unpack(points_from(first), states);
    for (std::size_t k = 0; k < cell_points; ++k) history_[first + k] = {values[2 * k], values[2 * k + 1]};
  });
  start_from_moved();
  static_cast<void>(evaluate(zero(), false));
  out_ << "resumed at " << throw_ << " m on " << mpi::n_mpi_processes(comm_) << " processes, saved by " << writers
       << ": reaction " << reaction() << " N, residual " << residual_ << "\n";
}

}  // namespace dealii_fault
