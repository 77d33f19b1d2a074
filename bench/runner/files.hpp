// Files and directories of runs. A file is written under a temporary name, brought to the disk, and then
// renamed, so that neither an interrupted program nor a power cut ever leaves half a file.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pfaff/bench/runner/directory_lock.hpp>
#include <pfaff/core/process/input_file.hpp>

namespace pfaff {

/// Opens a file that is not there yet, to write to it; negative where there is anything of this name, or none
/// can be made.
[[nodiscard]] int new_file(const std::filesystem::path& path);
/// Puts an open file, or the names that an open directory holds, onto the disk; true where that worked.
[[nodiscard]] bool brought_to_disk(int file);

/// Writes `text` to `path`, in a directory of ours, by way of a temporary file beside it, `path`.part, which
/// is a new one whatever stands there. RunError when the disk is full or not writable.
void write_file(const std::filesystem::path& path, const std::string& text);

/// The text of a file of ours, however long the run was that wrote it; nullopt where there is none that can
/// be read.
std::optional<std::string> text_in(const std::filesystem::path& path);

/// Refuses a path at which `option` is to leave a file where something stands there already, or where no file
/// can be made (InputError). Leaves nothing there.
void check_new_file(const std::filesystem::path& path, const std::string& option);

/// Writes `text` to a new file of the user's, and never over one that is there or into what a link leads to.
/// RunError where something stands there, or the disk is full or not writable; no half file is left.
void write_new_file(const std::filesystem::path& path, const std::string& text);

/// Renames a directory whose files are written already. RunError where that fails.
void rename_directory(const std::filesystem::path& from, const std::filesystem::path& to);

/// Makes a new directory, or takes an existing one, and holds it for `work`, a few words such as "pfaff run".
/// An existing one is taken where it holds the file `sign`, or nothing but files named in `ours` and what an
/// interrupted program leaves: their unfinished forms and a lock. InputError when `path` exists with anything
/// else in it, is held by another process, or cannot be made or written to.
std::unique_ptr<DirectoryLock> take_output_directory(const std::filesystem::path& path,
                                                     const std::string& work,
                                                     const std::vector<std::string>& ours = {},
                                                     const std::string& sign = {});

/// The file of the running program; empty where the system does not tell.
std::filesystem::path program_path();

/// Where the experiments, the report scripts and references.bib are: beside the installed library or, of one
/// that stands in its build tree, in the tree that it was built from. Empty for a library that was copied
/// without them.
std::optional<std::filesystem::path> find_data_directory();
/// The same; InputError where there is none.
std::filesystem::path data_directory();
/// The path of a file or folder that ships under the name that it has in the source tree, such as
/// "examples/models". InputError where there is no data directory.
std::filesystem::path shipped_path(const std::filesystem::path& name);

}  // namespace pfaff
