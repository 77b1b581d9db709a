// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "../shared/print.hpp"
#include "../shared/sand/sand_file.hpp"
#include "choices.hpp"
#include "commands.hpp"
#include "scarp/homogenise/balance.hpp"
#include "scarp/homogenise/fabric.hpp"
#include "scarp/io/packings/packing_file.hpp"
#include "scarp/run/run_folder.hpp"
#include "states.hpp"

namespace rve_lab {

/// Writes packing.packing with packing.sand, and in the plane its tables, into the folder.
/// \throws FileError
template <class PackingType>
void write_packing(Test const& choice, scarp::RunFolder& own, PackingType const& packing,
                   typename PackingType::Law const& law) {
  own.begin();
  remove_older(own,
               {"packing_particles.csv", "packing_contacts.csv", "packing_cell.csv", "packing.txt", "packing.data"});
  std::filesystem::path const& folder = own.path();
  auto const file = folder / "packing.packing";
  scarp::save_packing(file, packing);
  scarp::write_file(examples::sand_path(file), examples::text_of(choice.sand));
  auto const state = scarp::balance(packing, law);
  examples::print(stdout, "{}: void ratio {:.6f}, {:.0f} contacts, coordination {:.3f}, stress [Pa] ", file.string(),
                  packing.void_ratio(), state.contacts, scarp::contact_network(packing, law).coordination.all);
  if constexpr (PackingType::dim == 2) {
    write_state(folder, "packing", packing, law);
    if constexpr (requires { write_for_code(choice.format, folder, packing); }) {
      if (!choice.format.empty()) write_for_code(choice.format, folder / "packing", packing);
    }
    examples::print(stdout, "xx {:.1f}, xy {:.1f}, yy {:.1f}\n", state.stress(0, 0), state.stress(0, 1),
                    state.stress(1, 1));
  } else {
    examples::print(stdout, "xx {:.1f}, yy {:.1f}, zz {:.1f}\n", state.stress(0, 0), state.stress(1, 1),
                    state.stress(2, 2));
  }
}

}  // namespace rve_lab
