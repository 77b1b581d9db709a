// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>

#include "scarp/io/atomic_file.hpp"
#include "scarp/io/folder_lock.hpp"
#include "scarp/io/framed_file.hpp"
#include "scarp/io/read_file.hpp"
#include "scarp/io/text_lines.hpp"

namespace scarp {

/// A run cannot be continued from what is saved; the text reads "problem (why): suggestion".
class CheckpointError : public InputError {
 public:
  using InputError::InputError;
};

/// How a run is saved.
struct CheckpointSettings {
  std::filesystem::path folder{};  ///< of these checkpoints alone; empty: nothing is saved
  bool resume = false;             ///< continue from the newest one; afresh where there is none
  double every_seconds = 600.0;    ///< wall time between two of them
  int every_attempts = 0;          ///< also after so many attempts at a step; 0: by time alone
  bool locks = true;               ///< reserves the folder for this process; the other ranks of a run do not

  /// \throws InputError
  void validate() const {
    require_not_negative("time between two checkpoints [s]", every_seconds);
    if (every_attempts < 0)
      reject("the attempts between two checkpoints are {} (0 counts none): give 0 or more", every_attempts);
  }
};

namespace detail {

inline constexpr FileFormat checkpoint_format{"SCARPCHK", 9, "checkpoint", "a checkpointed run"};

/// \throws InputError naming the first line that differs
inline void reject_other_scene(std::string const& saved, std::string const& present) {
  if (saved == present) return;
  TextLines ours(present);
  TextLines theirs(saved);
  std::string_view our;
  std::string_view their;
  while (our == their && !(ours.done() && theirs.done())) {
    our = ours.done() ? "" : ours.take();
    their = theirs.done() ? "" : theirs.take();
  }
  reject("it is of another scene ('{}' there, '{}' here): request the scene that was saved, or choose another folder",
         their, our);
}

}  // namespace detail

/// The checkpoints of one run: numbered files in a folder of their own, of which the last two remain.
/// The content of one that is read stays in memory until release(). The folder is locked as long as this lives:
/// two programs cannot replace each other's checkpoints.
class CheckpointFiles {
 public:
  /// Saves nothing.
  CheckpointFiles() = default;

  /// scene: all choices that make the scene, a line for each; run_folder.hpp has the run's identity
  /// \throws FolderError for a folder that is in use or cannot be written
  /// \throws CheckpointError for a newest checkpoint that is harmed, of another scene, version or machine, and for an
  /// old one where the run is to start afresh
  CheckpointFiles(CheckpointSettings settings, std::string scene)
      : settings_(std::move(settings)), scene_(std::move(scene)) {
    settings_.validate();
    if (settings_.folder.empty()) return;
    if (settings_.locks) lock_ = FolderLock(settings_.folder, "checkpoints.lock");
    std::error_code trouble;
    auto const present = numbers(names(trouble));
    if (trouble && trouble != std::errc::no_such_file_or_directory) {
      throw CheckpointError(fmt::format("cannot look into '{}' ({}): check the folder of the checkpoints",
                                        settings_.folder.string(), trouble.message()));
    }
    if (present.empty()) return;
    number_ = present.back();
    auto const newest = path(number_);
    if (!settings_.resume) {
      throw CheckpointError(fmt::format(
          "'{}' holds checkpoints of an earlier run (one that starts afresh would replace them): continue it "
          "with --resume, or choose another folder",
          settings_.folder.string()));
    }
    try {
      bytes_ = fitting(newest);
    } catch (InputError const& error) {
      throw CheckpointError(
          fmt::format("cannot resume from '{}': {}{}", newest.string(), error.what(), way_back(present)));
    }
    StateReader reader(detail::payload_of(detail::checkpoint_format, bytes_));
    read_head(reader);
  }

  std::string const& scene() const { return scene_; }  ///< All choices that make the scene, a line for each.
  /// Which run is saved here, and the folder of its results; empty where they were not set.
  std::string const& run() const { return run_; }
  /// Folder of the run's results; empty where it was not set.
  std::string const& run_folder() const { return run_folder_; }
  /// Identity of the run and folder of its results, for the checkpoints that follow.
  void name_run(std::string run, std::string folder) {
    run_ = std::move(run);
    run_folder_ = std::move(folder);
  }

  bool saves() const { return !settings_.folder.empty(); }          ///< Whether there is a folder to save into.
  bool resumes() const { return !bytes_.empty(); }                  ///< Whether there is a checkpoint to continue from.
  CheckpointSettings const& settings() const { return settings_; }  ///< As they were given.
  std::filesystem::path newest() const { return path(number_); }    ///< File of the newest checkpoint.

  /// write(StateWriter&) adds what is to be saved
  /// \throws FileError when the file cannot be written; the earlier ones are then untouched
  template <class Write>
  void save(Write&& write) {
    make_folder(settings_.folder);
    auto const bytes = detail::framed(detail::checkpoint_format, [&](StateWriter& writer) {
      writer("scene", scene_);
      writer("run", run_);
      writer("folder of the run", run_folder_);
      write(writer);
    });
    write_file(path(number_ + 1), bytes, Durability::on_disk);  // before the older ones go
    ++number_;
    remove_older();
  }

  /// read(StateReader&) reads what write(...) has added; no more need be read than is wanted
  /// \throws CheckpointError when it is of another type or size; what has been read into is then unusable
  template <class Read>
  void load(Read&& read) const {
    try {
      StateReader reader(detail::payload_of(detail::checkpoint_format, bytes_));
      CheckpointFiles().read_head(reader);
      read(reader);
    } catch (InputError const& error) {
      throw CheckpointError(fmt::format("cannot resume from '{}': {}", path(number_).string(), error.what()));
    }
  }

  /// Frees the memory of a checkpoint that was loaded; resumes() is false from then on.
  void release() { bytes_ = {}; }

 private:
  static constexpr std::string_view stem = "checkpoint_";

  std::filesystem::path path(int number) const { return settings_.folder / fmt::format("{}{:06}", stem, number); }

  void read_head(StateReader& reader) {
    reader("scene", scene_);
    reader("run", run_);
    reader("folder of the run", run_folder_);
  }

  /// Bytes of a checkpoint of this scene.
  std::string fitting(std::filesystem::path const& file) const {
    std::string bytes = read_file(file);
    StateReader reader(detail::payload_of(detail::checkpoint_format, bytes));
    CheckpointFiles there;
    there.read_head(reader);
    detail::reject_other_scene(there.scene_, scene_);
    return bytes;
  }

  /// Where the newest one cannot be used but the one before can.
  std::string way_back(std::vector<int> const& present) const {
    if (present.size() < 2) return "";
    auto const before = path(present[present.size() - 2]);
    try {
      static_cast<void>(fitting(before));
    } catch (InputError const&) {
      return "";
    }
    return fmt::format("; the one before is '{}': to continue from that, move the newest to another folder",
                       before.string());
  }

  /// Names of all files in the folder.
  std::vector<std::string> names(std::error_code& trouble) const {
    std::vector<std::string> found;
    std::filesystem::directory_iterator file(settings_.folder, trouble);
    for (; !trouble && file != std::filesystem::directory_iterator(); file.increment(trouble))
      found.push_back(file->path().filename().string());
    return found;
  }

  /// Numbers of the checkpoints among files, increasing.
  static std::vector<int> numbers(std::vector<std::string> const& names) {
    std::vector<int> found;
    for (auto const& name : names) {
      if (!name.starts_with(stem) || name.size() > stem.size() + 9) continue;
      std::string const digits = name.substr(stem.size());
      if (!digits.empty() && digits.find_first_not_of("0123456789") == std::string::npos)
        found.push_back(std::stoi(digits));
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  /// Also what a killed process has not finished writing.
  void remove_older() const {
    std::error_code ignored;
    auto const present = names(ignored);
    for (int const number : numbers(present)) {
      if (number < number_ - 1) std::filesystem::remove(path(number), ignored);
    }
    for (auto const& name : present) {
      if (name.starts_with(stem) && name.find(".partial-") != std::string::npos)
        std::filesystem::remove(settings_.folder / name, ignored);
    }
  }

  CheckpointSettings settings_;
  std::string scene_;
  std::string run_;
  std::string run_folder_;
  std::string bytes_;
  int number_ = 0;
  FolderLock lock_;
};

}  // namespace scarp
