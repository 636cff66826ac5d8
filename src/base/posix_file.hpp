// Whole files by POSIX calls, with errors that say what to do.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace enfilade {

/// Returns all bytes of a file. Throws RunError.
std::vector<std::byte> read_file(const std::string& path);
/// Replaces a file by `head` followed by `body`, not atomically: for files that no other process
/// reads yet. Throws RunError.
void write_file(const std::string& path, std::span<const std::byte> head,
                std::span<const std::byte> body);
/// Gives a file its final name, replacing a file of that name. Across file systems: copies, then
/// renames. Throws RunError.
void move_file(const std::string& from, const std::string& to);
/// As move_file(), but where the file system can exchange names, the replaced file stays under the
/// name `from`, to be overwritten. Throws RunError.
void exchange_file(const std::string& from, const std::string& to);
/// Replaces a file atomically: if this process dies, the file holds all of the old or all of the
/// new text. Throws RunError.
void replace_file(const std::string& path, const std::string& text);
/// Flushes all that was written to the file system of `directory`, so that it outlives a power cut
/// (syncfs: seconds where much was written). Throws RunError.
void flush_to_disk(const std::string& directory);
/// Creates a directory and its parents. Throws RunError.
void make_directory(const std::string& path);
/// Removes a directory and all in it, or a file, where it exists. Throws RunError.
void remove_directory(const std::string& path);

}  // namespace enfilade
