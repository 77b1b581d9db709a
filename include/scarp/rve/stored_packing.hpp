// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <utility>

#include "scarp/dem/block/block_device.hpp"
#include "scarp/dem/time_stepping.hpp"

namespace scarp {

namespace detail {
/// Cell, grains that never change and age of the list of a packing.
template <class PackingType>
PackingType outline_of(PackingType const& packing) {
  PackingType outline;
  outline.population = packing.population;
  outline.cell = packing.cell;
  outline.last_move = packing.last_move;
  outline.pairs.drift = packing.pairs.drift;
  outline.pairs.skin = packing.pairs.skin;
  outline.pairs.critical_step = packing.pairs.critical_step;
  outline.pairs.basis = packing.pairs.basis;
  return outline;
}
}  // namespace detail

/// A packing on the processor, on a device or on both: it goes where somebody needs it first, and is never changed, so
/// that states share it. Several threads may call it.
/// \tparam PackingType a `Packing` \tparam Device a `BlockDevice`
template <class PackingType, class Device>
class StoredPacking {
 public:
  using Law = typename PackingType::Law;                                                 ///< of the contacts
  using State = BlockState<typename Device::Types>;                                      ///< on the device
  using Header = typename Device::Header;                                                ///< what a response reports
  using Parameters = BlockParameters<typename Device::Types, typename Device::Damping>;  ///< of responses

  /// On the processor.
  explicit StoredPacking(PackingType packing) : packing_(std::move(packing)) {}
  /// On the device. outline: the packing without grains and contacts; bytes: a state of this size with this header
  StoredPacking(std::shared_ptr<Device> device, PackingType outline, typename Device::Bytes bytes, BlockSize size,
                Header const& header)
      : packing_(std::move(outline)),
        is_here_(false),
        device_(std::move(device)),
        bytes_(std::move(bytes)),
        size_(size),
        header_(header),
        basis_(packing_.pairs.basis),
        skin_(packing_.pairs.skin) {}

  /// The packing, which is read from the device if it is not here.
  PackingType const& packing() const {
    std::lock_guard const lock(mutex_);
    if (!is_here_) fetch();
    return packing_;
  }

  /// The state on a device and its header, which has a trouble where the device cannot observe the packing, or has it
  /// for another law: the processor responds then. What it needs is written there first if it is not there.
  std::pair<State, Header> on(std::shared_ptr<Device> const& device, Parameters const& parameters) const {
    std::lock_guard const lock(mutex_);
    if (device_ != device) {
      if (!is_here_) fetch();
      place(device, parameters);
    }
    Header header = header_;
    // List and stiffness of another law are not this one's, and its points may be at work with them.
    if (!basis_.agrees_with(list_basis(packing_, parameters.law, skin_))) header.trouble = Trouble::unconverged_touch;
    return {State(bytes_.get(), size_), header};
  }

  /// Whether it is on this device.
  bool is_on(std::shared_ptr<Device> const& device) const {
    std::lock_guard const lock(mutex_);
    return device_ == device;
  }

 private:
  void fetch() const {
    AlignedVector<std::byte> bytes(State::bytes(size_));
    device_->read(bytes_.get(), bytes);
    auto const grains = detail::index(header_.grains);
    packing_.position.resize(grains);
    packing_.velocity.resize(grains);
    packing_.spin.resize(grains);
    packing_.orientation.resize(grains);
    from_block(State(bytes.data(), size_), packing_);
    is_here_ = true;
  }

  void place(std::shared_ptr<Device> const& device, Parameters const& parameters) const {
    TimeStepper<PackingType, typename Device::Damping> const stepper;
    header_ = {};
    header_.trouble = Trouble::unconverged_touch;  // until the device has it, the processor responds
    PackingType listed = packing_;
    if (!stepper.refresh(listed, parameters.law).acceptable()) return;
    auto const room = device->room(static_cast<int>(listed.grain_count()), static_cast<int>(listed.pairs.count()));
    if (!room) return;
    size_ = *room;
    AlignedVector<std::byte> here(State::bytes(size_));
    to_block(listed, State(here.data(), size_));
    auto const given = device->allocate(here.size());
    bytes_ = device->allocate(here.size());
    device->write(here, given.get());
    BlockTask<typename Device::Types> const look{
        State(given.get(), size_), State(bytes_.get(), size_), device->grains(packing_.population), 0, {}};
    device->respond(std::span(&look, 1), parameters, std::span(&header_, 1));
    device_ = device;
    basis_ = listed.pairs.basis;
    skin_ = listed.pairs.skin;
  }

  mutable std::mutex mutex_;
  mutable PackingType packing_;  ///< only an outline while it is not here
  mutable bool is_here_ = true;
  mutable std::shared_ptr<Device> device_;  ///< null while it is on no device
  mutable typename Device::Bytes bytes_;
  mutable BlockSize size_{};
  mutable Header header_{};
  mutable ListBasis basis_{};   ///< of the list on the device
  mutable double skin_ = -1.0;  ///< of that list [m]
};

}  // namespace scarp
