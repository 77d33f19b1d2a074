#include <pfaff/core/process/loaded_objects.hpp>

#include <link.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <stdexcept>

#include <pfaff/core/process/checksum.hpp>
#include <pfaff/core/process/input_file.hpp>

namespace pfaff {

namespace {
// Copies what the loader says of each object, because nothing should be done while it holds its lock.
// Segments stay where they are as long as the object is loaded.
std::vector<dl_phdr_info> objects_of_process() {
  std::vector<dl_phdr_info> objects;
  dl_iterate_phdr(
      [](dl_phdr_info* object, std::size_t /*size*/, void* data) {
        static_cast<std::vector<dl_phdr_info>*>(data)->push_back(*object);
        return 0;
      },
      &objects);
  return objects;
}

// The start of a segment in memory. Addresses of segments are given relative to where the object was put.
const char* start_of(const dl_phdr_info& object, const ElfW(Phdr) & segment) {
  // NOLINTNEXTLINE(performance-no-int-to-ptr): the loader gives addresses as integers
  return reinterpret_cast<const char*>(static_cast<std::uintptr_t>(object.dlpi_addr + segment.p_vaddr));
}

std::string hexadecimal(const char* bytes, std::size_t count) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  for (std::size_t k = 0; k < count; ++k) {
    const auto byte = static_cast<unsigned char>(bytes[k]);
    text += digits[byte >> 4U];
    text += digits[byte & 15U];
  }
  return text;
}

// The build ID among the notes of a segment, or empty. Notes are looked for at every word instead of being
// followed from one to the next, because there may be padding of any length between them.
std::string build_id_in(const char* notes, std::size_t size) {
  static constexpr std::array<char, 4> name{'G', 'N', 'U', '\0'};
  constexpr std::string_view owner(name.data(), name.size());
  for (std::size_t at = 0; at + sizeof(ElfW(Nhdr)) + owner.size() <= size; at += 4) {
    ElfW(Nhdr) note;
    std::memcpy(&note, notes + at, sizeof note);
    const std::size_t content = at + sizeof note + owner.size();
    if (note.n_type == NT_GNU_BUILD_ID && note.n_namesz == owner.size() &&
        owner == std::string_view(notes + at + sizeof note, owner.size()) && note.n_descsz <= size - content)
      return hexadecimal(notes + content, note.n_descsz);
  }
  return {};
}

LoadedObject described(const dl_phdr_info& object) {
  LoadedObject result;
  // The program is the object without a name.
  std::error_code error;
  const std::string name = object.dlpi_name;
  result.path = name.empty() ? std::filesystem::read_symlink("/proc/self/exe", error).string()
                             : std::filesystem::absolute(name, error).lexically_normal().string();
  for (int k = 0; k < object.dlpi_phnum && result.build.empty(); ++k)
    if (const auto& segment = object.dlpi_phdr[k]; segment.p_type == PT_NOTE)
      result.build = build_id_in(start_of(object, segment), segment.p_memsz);
  if (result.build.empty() && std::filesystem::is_regular_file(result.path, error))
    result.build = "sha1-" + sha1_of(read_file(result.path));
  return result;
}
}  // namespace

std::vector<LoadedObject> loaded_objects() {
  std::vector<LoadedObject> objects;
  for (const dl_phdr_info& object : objects_of_process()) objects.push_back(described(object));
  return objects;
}

LoadedObject object_holding(const void* address) {
  const auto* at = static_cast<const char*>(address);
  for (const dl_phdr_info& object : objects_of_process())
    for (int k = 0; k < object.dlpi_phnum; ++k) {
      const auto& segment = object.dlpi_phdr[k];
      const char* begin = start_of(object, segment);
      if (segment.p_type == PT_LOAD && std::less_equal<>()(begin, at) &&
          std::less<>()(at, begin + segment.p_memsz))
        return described(object);
    }
  throw std::logic_error("no loaded object holds the address");
}

}  // namespace pfaff
