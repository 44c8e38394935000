#include "base/build_id.hpp"

#include <elf.h>
#include <fmt/format.h>
#include <link.h>

#include <cstring>
#include <fstream>
#include <span>
#include <string_view>
#include <vector>

namespace mrroc {
namespace {

constexpr std::size_t kMostNotes = 65536;  // [bytes]

/// Reads a part of a file. @return empty: the file has no such part
std::vector<char> part_of(std::ifstream& in, std::size_t offset, std::size_t size) {
  std::vector<char> bytes(size);
  in.clear();
  in.seekg(static_cast<std::streamoff>(offset));
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  return in ? bytes : std::vector<char>{};
}

template <class T>
bool read(std::ifstream& in, std::size_t offset, T& value) {
  const std::vector<char> bytes = part_of(in, offset, sizeof value);
  if (!bytes.empty()) std::memcpy(&value, bytes.data(), sizeof value);
  return !bytes.empty();
}

constexpr std::size_t aligned(std::size_t size) { return (size + 3) / 4 * 4; }

std::string build_id_among(std::span<const char> notes) {
  using Note = ElfW(Nhdr);
  while (notes.size() >= sizeof(Note)) {
    Note note{};
    std::memcpy(&note, notes.data(), sizeof note);
    notes = notes.subspan(sizeof note);
    const std::size_t name = aligned(note.n_namesz), text = aligned(note.n_descsz);
    if (name > notes.size() || text > notes.size() - name) break;
    const bool gnu = note.n_namesz == sizeof ELF_NOTE_GNU &&
                     std::memcmp(notes.data(), ELF_NOTE_GNU, sizeof ELF_NOTE_GNU) == 0;
    if (gnu && note.n_type == NT_GNU_BUILD_ID) {
      std::string id;
      for (const char byte : notes.subspan(name, note.n_descsz))
        id += fmt::format("{:02x}", static_cast<unsigned char>(byte));
      return id;
    }
    notes = notes.subspan(name + text);
  }
  return {};
}

}  // namespace

std::string build_id(const std::filesystem::path& program) {
  std::ifstream in(program, std::ios::binary);
  ElfW(Ehdr) header{};
  if (!read(in, 0, header) ||
      std::string_view(ELFMAG) != std::string_view(reinterpret_cast<const char*>(header.e_ident), SELFMAG))
    return {};
  for (std::size_t k = 0; k < header.e_phnum; ++k) {
    ElfW(Phdr) segment{};
    if (!read(in, header.e_phoff + k * sizeof segment, segment)) return {};
    if (segment.p_type != PT_NOTE || segment.p_filesz > kMostNotes) continue;
    const std::vector<char> notes = part_of(in, segment.p_offset, segment.p_filesz);
    if (std::string id = build_id_among(notes); !id.empty()) return id;
  }
  return {};
}

}  // namespace mrroc
