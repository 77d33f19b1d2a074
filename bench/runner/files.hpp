// Files and directories of runs: written to a temporary name and renamed, so that nothing is ever half there.
#pragma once

#include <filesystem>
#include <string>

namespace pfaff {

/// Writes `text` to `path` by way of a temporary file beside it. RunError when the disk is full or not
/// writable.
void write_file(const std::filesystem::path& path, const std::string& text);

/// The text of a file. InputError when it cannot be read.
std::string read_file(const std::filesystem::path& path);

/// Makes a new directory that is ready to write to. InputError when `path` exists with something in it, or
/// when it cannot be made or written.
void make_output_directory(const std::filesystem::path& path);

/// Where the experiments, the report scripts and references.bib are: beside the installed program, or in the
/// tree the program was built from.
std::filesystem::path data_directory();

}  // namespace pfaff
