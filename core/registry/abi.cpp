#include <pfaff/core/registry/abi.hpp>

#include <link.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <pfaff/core/errors/errors.hpp>

namespace pfaff {

namespace {
// Reads `count` bytes at `offset`; false past the end.
bool read_at(std::ifstream& file, std::uint64_t offset, void* to, std::uint64_t count) {
  file.clear();
  file.seekg(static_cast<std::streamoff>(offset));
  file.read(static_cast<char*>(to), static_cast<std::streamsize>(count));
  return file && static_cast<std::uint64_t>(file.gcount()) == count;
}

// Adds the texts of Pfaff's notes among the notes in `bytes`. Notes are looked for at every word instead of
// being followed from one to the next, because compilers and sanitizers add padding between them, behind
// which a note would be missed.
void collect_stamps(const std::vector<char>& bytes, std::vector<std::string>& stamps) {
  constexpr std::size_t owner_room = 8;
  for (std::size_t at = 0; at + sizeof(ElfW(Nhdr)) + owner_room <= bytes.size(); at += 4) {
    ElfW(Nhdr) note;
    std::memcpy(&note, bytes.data() + at, sizeof note);
    const char* owner = bytes.data() + at + sizeof note;
    const std::size_t room = bytes.size() - at - sizeof note - owner_room;
    if (note.n_namesz != sizeof("Pfaff") || std::memcmp(owner, "Pfaff", sizeof("Pfaff")) != 0) continue;
    const std::string stamp(owner + owner_room, std::min<std::size_t>(note.n_descsz, room));
    stamps.push_back(stamp.substr(0, stamp.find('\0')));
  }
}

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> result;
  for (std::string word; stream >> word;) result.push_back(word);
  return result;
}

// The words of `a` that are not in `b`; all of them when that leaves none.
std::string difference(const std::string& a, const std::string& b) {
  const std::vector<std::string> other = words(b);
  std::string result;
  for (const std::string& word : words(a))
    if (std::find(other.begin(), other.end(), word) == other.end())
      result += (result.empty() ? "" : " ") + word;
  return result.empty() ? a : result;
}
}  // namespace

std::vector<std::string> abi_stamps(const std::string& path) {
  // Whoever opens a pipe waits for its other end, and a device may never end: only files are opened.
  std::error_code error;
  const auto kind = std::filesystem::status(path, error).type();
  if (kind != std::filesystem::file_type::regular && kind != std::filesystem::file_type::not_found)
    throw InputError("plug-in '" + path +
                     "': is no regular file; expected a shared object built against Pfaff");
  std::ifstream file(path, std::ios::binary);
  const std::uint64_t size = std::filesystem::file_size(path, error);
  if (!file || error) throw InputError("plug-in '" + path + "': cannot be read");
  ElfW(Ehdr) header;
  constexpr unsigned char native = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;
  if (!read_at(file, 0, &header, sizeof header) || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0 ||
      header.e_ident[EI_CLASS] != native || header.e_type != ET_DYN ||
      header.e_phentsize != sizeof(ElfW(Phdr)))
    throw InputError("plug-in '" + path + "': expected a shared object built against Pfaff");
  std::vector<std::string> stamps;
  for (std::uint64_t k = 0; k < header.e_phnum; ++k) {
    ElfW(Phdr) segment;
    constexpr std::uint64_t most = 1U << 20U;  // notes are small; a larger size is a damaged file's
    const bool read = read_at(file, header.e_phoff + k * sizeof segment, &segment, sizeof segment);
    // A segment is mapped into memory; the part that lies behind the end of the file can be mapped but not
    // read, and the first look at it ends the process.
    if (!read || (segment.p_type != PT_NULL && segment.p_type != PT_GNU_STACK &&
                  (segment.p_offset > size || segment.p_filesz > size - segment.p_offset ||
                   (segment.p_type == PT_LOAD && segment.p_filesz > segment.p_memsz))))
      throw InputError("plug-in '" + path + "': is cut off or damaged, its segment " + std::to_string(k + 1) +
                       " reaches behind the end of the file; expected a whole shared object");
    if (segment.p_type != PT_NOTE || segment.p_filesz > most) continue;
    std::vector<char> bytes(segment.p_filesz);
    if (read_at(file, segment.p_offset, bytes.data(), bytes.size())) collect_stamps(bytes, stamps);
  }
  return stamps;
}

std::string own_abi_stamp() { return abi_note.text; }

void require_same_abi(const std::string& path) {
  const std::vector<std::string> stamps = abi_stamps(path);
  if (stamps.empty())
    throw InputError("plug-in '" + path +
                     "': has no Pfaff ABI stamp; expected a shared object built against Pfaff");
  const std::string own = own_abi_stamp();
  for (const std::string& stamp : stamps)
    if (stamp != own)
      throw InputError("plug-in '" + path + "': built for " + difference(stamp, own) + "; expected " +
                       difference(own, stamp));
}

}  // namespace pfaff
