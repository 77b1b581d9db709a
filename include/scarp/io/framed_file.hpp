// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/io/state_bits.hpp"

namespace scarp {

/// Header of a binary file.
struct FileFormat {
  std::string_view magic;    ///< eight letters
  std::uint32_t version;     ///< files of other versions are rejected
  std::string_view content;  ///< such as "packing"
  std::string_view maker;    ///< what writes such files
};

namespace detail {

inline constexpr std::uint32_t byte_order_mark = 0x01020304U;

/// FNV-1a of 64 bits (Fowler, Noll and Vo): finds every single wrong byte.
inline std::uint64_t hash_of(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (char const byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3ULL;
  return hash;
}

/// Bytes of a file: magic, order of bytes, version, length of the payload, payload, hash of all before.
/// write(StateWriter&) makes the payload
template <class Write>
std::string framed(FileFormat const& format, Write&& write) {
  StateWriter file;
  std::uint64_t length = 0;
  file.put(format.magic.data(), format.magic.size());
  file.put(&byte_order_mark, sizeof(byte_order_mark));
  file.put(&format.version, sizeof(format.version));
  file.put(&length, sizeof(length));
  std::size_t const start = file.bits().size();
  write(file);
  length = file.bits().size() - start;
  std::memcpy(file.bits().data() + start - sizeof(length), &length, sizeof(length));
  std::uint64_t const hash = hash_of(file.bits());
  file.put(&hash, sizeof(hash));
  return std::move(file.bits());
}

/// \throws InputError unless the file is of this format and version, whole, unharmed and of this machine's order of
/// bytes
inline std::string_view payload_of(FileFormat const& format, std::string_view file) {
  if (!file.starts_with(format.magic)) {
    reject("it is no {} (it does not begin with {}): give a file that {} wrote", format.content, format.magic,
           format.maker);
  }
  StateReader reader(file.substr(format.magic.size()));
  std::uint32_t mark = 0;
  std::uint32_t version = 0;
  std::uint64_t length = 0;
  reader.take("order of bytes", &mark, sizeof(mark));
  if (mark != byte_order_mark) {
    reject(
        "its order of bytes is {:#010x} (this machine writes {:#010x}): load it on a machine like the one that saved "
        "it",
        mark, byte_order_mark);
  }
  reader.take("version", &version, sizeof(version));
  if (version != format.version) {
    reject("it is of version {} (this library reads version {}): save it again with this library", version,
           format.version);
  }
  reader.take("length", &length, sizeof(length));
  std::size_t const start = format.magic.size() + sizeof(mark) + sizeof(version) + sizeof(length);
  std::uint64_t hash = 0;
  if (file.size() < start + sizeof(hash) || file.size() - start - sizeof(hash) != length) {
    reject("it has {} bytes (its header promises {} behind the first {}): it was cut off or added to, save it again",
           file.size(), length, start);
  }
  std::memcpy(&hash, file.data() + file.size() - sizeof(hash), sizeof(hash));
  if (hash != hash_of(file.substr(0, file.size() - sizeof(hash)))) {
    reject("its bytes have changed since it was written (hash {:#x} does not fit): save it again", hash);
  }
  return file.substr(start, static_cast<std::size_t>(length));
}

}  // namespace detail
}  // namespace scarp
