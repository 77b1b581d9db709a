// SPDX-License-Identifier: BSL-1.0
// Damaged files against every reader: it returns something sound or throws InputError or FileError with a message, soon
// and within bounded memory. fuzz_readers --seed S [--inputs N | --seconds T] [--only READER] [--first K];
// docs/notes/testing.md
#include "adversary/readers.hpp"

int main(int count, char** words) {
  using namespace adversary;
  std::vector<Game> games;
  for (auto const& room : {readers_of_meshes, readers_of_tables, readers_of_packings,
#ifdef ADVERSARY_OPTIONS
                           readers_of_options
#endif
       }) {
    for (auto& game : room()) games.push_back(std::move(game));
  }
  return contest(count, words, games);
}
