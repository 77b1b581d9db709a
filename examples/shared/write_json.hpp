// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "scarp/io/atomic_file.hpp"

namespace examples {

/// Writes JSON, whatever the bytes of its names. \throws scarp::FileError
template <class Json>
void write_json(std::filesystem::path const& file, Json const& json) {
  scarp::write_file(file, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace examples
