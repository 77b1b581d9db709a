// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <exception>
#include <random>

#include "scarp/core/process.hpp"
#include "scarp/io/checkpoint_files.hpp"
#include "scarp/io/folder_lock.hpp"
#include "scarp/run/run_record.hpp"

namespace scarp {

/// Requirements on the folder that a run writes its results into.
struct RunFolderSettings {
  std::filesystem::path folder{};   ///< made where it does not exist
  bool overwrite = false;           ///< the results of another run may be replaced
  std::string record = "run.json";  ///< file of the run's record; runs with different ones can live in one folder
  std::vector<std::string> results{"summary.json"};  ///< names that show results where there is no record
};

/// The output folder of one run. As long as this object lives, no other run can have it.
/// \code
/// CheckpointFiles files({.folder = "states", .resume = true}, scene);
/// RunFolder folder({.folder = "out"}, {.program = "my_program", .options = options}, &files);
/// // read input, prepare
/// folder.begin();
/// // write results
/// folder.end("finished");
/// \endcode
/// A new run uses a folder without results, or any that it may overwrite. A run that resumes from a checkpoint uses its
/// own folder only. One that is to resume and finds no checkpoint uses that of an unfinished run of the same scene,
/// which has made none. Until begin() nothing in the folder is changed: a run that is rejected, here or later, leaves
/// it as it was.
class RunFolder {
 public:
  /// files: where the run saves itself, if it does; they receive its identity
  /// \throws FolderError for a folder that is in use, holds results that must not be lost, or cannot be written
  RunFolder(RunFolderSettings settings, RunRecord record, CheckpointFiles* files = nullptr)
      : settings_(std::move(settings)), record_(std::move(record)), lock_(settings_.folder) {
    std::random_device random;
    record_.started = time_stamp();
    record_.identity = fmt::format("{}-{:08x}{:08x}", record_.started, random(), random());
    if (files != nullptr && files->saves()) {
      record_.checkpoint = absolute(files->settings().folder);
      record_.scene = valid_utf8(files->scene());  // as the record has it
    }
    auto const before = present();
    if (files != nullptr && files->resumes()) {
      take_own(before, *files);
    } else if (!settings_.overwrite) {
      require_new(before, files != nullptr && files->settings().resume);
    }
    if (files != nullptr) files->name_run(record_.identity, absolute(settings_.folder));
  }

  std::filesystem::path const& path() const { return settings_.folder; }  ///< As the settings name it.
  /// The record of this run; its identity and start are those of the run that is resumed.
  RunRecord const& record() const { return record_; }

  /// From now on the folder is this run's.
  /// \throws FileError
  void begin() {
    if (record_.state.empty()) write("running");
  }

  /// state: finished, or why the run has stopped; it may be resumed later
  /// \throws FileError
  void end(std::string state) { write(std::move(state)); }

  RunFolder(RunFolder const&) = delete;
  RunFolder& operator=(RunFolder const&) = delete;
  /// A run that an exception ends has not stayed running.
  ~RunFolder() {
    if (record_.state != "running" || std::uncaught_exceptions() <= exceptions_) return;
    try {
      end("failed");
    } catch (...) {  // the present exception has more information
    }
  }

 private:
  static std::string absolute(std::filesystem::path const& path) {
    std::error_code trouble;
    auto const found = std::filesystem::weakly_canonical(path, trouble);
    return valid_utf8((trouble ? path : found).string());  // as the record has it
  }

  std::string name() const { return settings_.folder.string(); }

  /// The run whose folder this is.
  std::optional<RunRecord> present() const {
    auto const file = settings_.folder / settings_.record;
    if (std::error_code none; !std::filesystem::exists(file, none)) return std::nullopt;
    try {
      return RunRecord::from(read_file(file));
    } catch (InputError const& problem) {
      if (settings_.overwrite) return std::nullopt;
      throw FolderError(fmt::format("'{}' cannot be recognised as a run's ('{}': {}), or choose another folder", name(),
                                    settings_.record, problem.what()));
    }
  }

  void take_own(std::optional<RunRecord> const& before, CheckpointFiles const& files) {
    if (before && before->identity == files.run()) {
      record_.identity = before->identity;
      record_.started = before->started;
      return;
    }
    throw FolderError(
        fmt::format("'{}' holds {}, not the run that '{}' is a checkpoint of (that one writes into '{}'): "
                    "give that folder for the output, or the checkpoints of this run",
                    name(), before ? before->described() : "no run", files.newest().string(),
                    files.run_folder().empty() ? "an unknown folder" : files.run_folder()));
  }

  void require_new(std::optional<RunRecord> const& before, bool wants_to_go_on) const {
    std::string found = before ? before->described() : "";
    for (auto const& result : settings_.results) {
      if (std::error_code none; found.empty() && std::filesystem::exists(settings_.folder / result, none))
        found = fmt::format("results of another run, such as '{}'", result);
    }
    if (found.empty()) return;
    if (!wants_to_go_on) {
      throw FolderError(fmt::format(
          "'{}' holds {} (its results would be lost): choose another folder, or add --overwrite", name(), found));
    }
    if (before && !before->has_finished() && before->checkpoint == record_.checkpoint && before->scene == record_.scene)
      return;
    std::string const theirs = before ? before->checkpoint : "";
    throw FolderError(
        fmt::format("'{}' holds {}, and there is no checkpoint in '{}' to resume from ({}): {}choose another "
                    "output folder for a new run",
                    name(), found, record_.checkpoint,
                    theirs.empty()                 ? "it saved none"
                    : theirs == record_.checkpoint ? "its checkpoints are gone, or its scene is another"
                                                   : fmt::format("it saves into '{}'", theirs),
                    theirs.empty() || theirs == record_.checkpoint ? "" : "give that folder to resume, or "));
  }

  void write(std::string state) {
    RunRecord changed = record_;
    changed.state = std::move(state);
    changed.changed = time_stamp();
    auto const file = settings_.folder / settings_.record;
    try {
      write_file(file, changed.text());
    } catch (FileError const&) {
      if (!write_in_place(file, changed.text())) throw;
    }
    record_ = std::move(changed);
  }

  /// On a full disk: the blocks that the file has are there still. Where they are too few, the file stays as it was.
  static bool write_in_place(std::filesystem::path const& path, std::string const& text) {
    if (std::error_code none; !std::filesystem::exists(path, none)) return false;
    std::string const before = read_file(path);
    bool const written = replaced(path, text);
    if (!written) replaced(path, before);
    return written;
  }

  static bool replaced(std::filesystem::path const& path, std::string const& text) {
    std::error_code trouble;
    detail::OpenFile const file(std::fopen(path.string().c_str(), "r+b"));
    bool const written =
        file && std::fwrite(text.data(), 1, text.size(), file.get()) == text.size() && std::fflush(file.get()) == 0;
    if (written) std::filesystem::resize_file(path, text.size(), trouble);
    return written && !trouble;
  }

  RunFolderSettings settings_;
  RunRecord record_;
  FolderLock lock_;
  int exceptions_ = std::uncaught_exceptions();  ///< under way when this was made
};

}  // namespace scarp
