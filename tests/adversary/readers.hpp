// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>

#include "adversary/contest.hpp"
#include "adversary/damage.hpp"
#include "scarp/core/error.hpp"
#include "scarp/io/atomic_file.hpp"
#include "support/files.hpp"

/// Readers under attack, each with valid files to begin with.
namespace adversary {

using samples::content;
using samples::ScratchFolder;
using scarp::InputError;
using scarp::Random;

/// It says what is wrong and what to do, on a terminal too.
inline void check_message(std::string_view said) {
  auto const control = [](char letter) {
    return (letter >= 0 && letter < ' ' && letter != '\n' && letter != '\t') || letter == 0x7f;
  };
  demand(std::none_of(said.begin(), said.end(), control), "a refusal with control characters");
  auto const colon = said.rfind(": ");
  demand(colon != std::string_view::npos && colon > 10 && colon + 5 < said.size(),
         fmt::format("a refusal that says '{}'", said));
}

/// A reader with valid files; use(bytes) reads and checks what comes of it.
inline Game reader(std::string name, std::vector<std::string> samples, std::function<void(std::string const&)> use,
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

std::vector<Game> readers_of_meshes();
std::vector<Game> readers_of_packings();
std::vector<Game> readers_of_tables();
std::vector<Game> readers_of_options();

}  // namespace adversary
