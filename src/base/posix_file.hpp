// Whole files by POSIX calls, with errors that say what to do.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace enfilade {

/// All of a file. Throws RunError.
std::vector<std::byte> read_file(const std::string& path);
/// Replaces a file, not atomically: for files that nobody else looks at yet. Throws RunError.
void write_file(const std::string& path, std::span<const std::byte> head,
                std::span<const std::byte> body);
/// Gives a file its final name, replacing what had it. Across file systems: copies, then renames.
void move_file(const std::string& from, const std::string& to);
/// As move_file(), but leaves what had the name under the old one where the file system can, to be
/// written over.
void exchange_file(const std::string& from, const std::string& to);
/// Replaces a file so that whenever this process dies, all of the old or all of the new one is
/// there.
void replace_file(const std::string& path, const std::string& text);
/// Everything written to the file system of `directory` so far will outlive a power cut. Takes a
/// while.
void flush_to_disk(const std::string& directory);
/// Creates a directory and its parents. Throws RunError.
void make_directory(const std::string& path);
/// Removes a directory and all in it, or a file, where it exists. Throws RunError.
void remove_directory(const std::string& path);

}  // namespace enfilade
