// What a run is made of besides its settings: the contents of the files it reads and the builds of the
// libraries and plug-ins that compute it. With the settings they are the identity of the run.
#pragma once

#include <string>
#include <vector>

#include <pfaff/core/registry/plugin.hpp>

namespace pfaff {

/// Names with their hashes, each list in the order of its names.
struct Origins {
  Assignments files;    // absolute paths of model files, and the SHA-1 of their contents
  Assignments plugins;  // absolute paths of plug-ins' shared objects, and their builds (LoadedObject::build)
  // File names of Pfaff's and of mathematical libraries, and their builds; "values of libm", a checksum of
  // what its functions give at fixed points; of a run whose formulas are compiled also "native", and which
  // compiler makes the code.
  Assignments libraries;
};

/// `assignments` with the paths of files, relative ones to the working directory, made absolute. InputError
/// for a path that is no UTF-8, because files of runs could not hold it.
Assignments with_absolute_paths(const std::vector<Parameter>& parameters, Assignments assignments);

/// The files that a plug-in reads with these values of its parameters, plug-ins among the values included,
/// with their hashes. InputError for a file that cannot be read.
Assignments files_of(const std::vector<Parameter>& parameters, const Assignments& values);

/// Adds a file with the hash of its contents.
void add_file(Origins& origins, const std::string& path, const std::string& hash);

/// Adds the compiler that makes code of formulas, or that there is none.
void add_compiler(Origins& origins);

/// Adds the files that the plug-in reads with these values and the shared objects that it, the plug-ins among
/// its values and those that a table of coefficients names come from. Objects of Pfaff itself are libraries
/// and not added.
void add_origins(const Plugin& plugin, const Assignments& values, Origins& origins);

/// Adds the library of plug-ins, where a plug-in of it has the name of what was made in a program, whose code
/// may then be the library's; null is none.
void add_library_of(const Plugin* namesake, Origins& origins);

/// The libraries that compute every run: Pfaff's own, libm, with its values at fixed points, and libquadmath.
const Assignments& libraries();

/// What has become of the origins `before`, a phrase for each that is another now, such as "/a/model.toml has
/// changed". Lists that are empty in `before` are not compared, as of a configuration written by hand.
std::vector<std::string> differences(const Origins& before, const Origins& now);

/// Phrases in one line, of which at most three are spelt out.
std::string in_one_line(const std::vector<std::string>& phrases);

/// InputError, beginning with `where`, unless every plug-in of a run that was made before, or another of its
/// file name, is loaded. None is loaded here: a file that somebody else wrote names them.
void require_plugins(const Origins& origins, const std::string& where);

}  // namespace pfaff
