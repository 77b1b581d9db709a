// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/io/atomic_file.hpp"
#include "scarp/io/detail/xml_text.hpp"

namespace scarp {

/// A time series of VTU files in one folder, listed in `<folder>/<name>.pvd`, which ParaView opens as one animation.
class PvdSeries {
 public:
  /// Time and file, relative to the folder.
  using Entry = std::pair<double, std::string>;

  /// earlier: what entries() was when a run that is now continued was saved
  PvdSeries(std::filesystem::path folder, std::string name, std::vector<Entry> earlier = {})
      : folder_(std::move(folder)), name_(std::move(name)), entries_(std::move(earlier)) {}

  std::filesystem::path path() const { return folder_ / (name_ + ".pvd"); }

  std::vector<Entry> const& entries() const { return entries_; }

  /// Lists one more file and rewrites the list as a whole, so that an interrupted run leaves a complete one.
  /// time: the load factor or what the pictures are ordered by, increasing; file: name relative to the folder
  /// \throws InputError for a time that is not above the last one, FileError when the list cannot be written
  void add(double time, std::filesystem::path const& file) {
    if (!std::isfinite(time) || (!entries_.empty() && !(time > entries_.back().first))) {
      refuse("time {} of '{}' cannot be added (times must be finite and increase): order the files", time,
             file.string());
    }
    entries_.emplace_back(time, file.generic_string());
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n";
    for (auto const& [when, what] : entries_) {
      text += fmt::format("<DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n", when, xml_text(what));
    }
    write_file(path(), text + "</Collection>\n</VTKFile>\n");
  }

  SCARP_MEMBERS_EXCEPT((folder_, name_), entries_)

 private:
  std::filesystem::path folder_;
  std::string name_;
  std::vector<Entry> entries_;
};

}  // namespace scarp
