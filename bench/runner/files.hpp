// Files and directories of runs. A file is written under a temporary name, brought to the disk, and then
// renamed, so that neither an interrupted program nor a power cut ever leaves half a file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <pfaff/core/process/input_file.hpp>

namespace pfaff {

/// Writes `text` to `path` by way of a temporary file beside it. RunError when the disk is full or not
/// writable.
void write_file(const std::filesystem::path& path, const std::string& text);

/// Renames a directory whose files are written already. RunError where that fails.
void rename_directory(const std::filesystem::path& from, const std::filesystem::path& to);

/// Makes a new directory that can be written to. An existing one is taken where it holds nothing but files
/// named in `ours` and what an interrupted program leaves: their unfinished forms and a lock. InputError when
/// `path` exists with anything else in it, or cannot be made or written.
void make_output_directory(const std::filesystem::path& path, const std::vector<std::string>& ours = {});

/// The file of the running program; empty where the system does not tell.
std::filesystem::path program_path();

/// Where the experiments, the report scripts and references.bib are: beside the installed program or, of a
/// program that stands in its build tree, in the tree that it was built from. Empty for a program that was
/// copied without them.
std::optional<std::filesystem::path> find_data_directory();
/// The same; InputError where there is none.
std::filesystem::path data_directory();

}  // namespace pfaff
