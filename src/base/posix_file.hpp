// Whole files by POSIX calls, with errors that say what to do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace enfilade {

/// Returns all bytes of a regular file. Throws RunError, for anything else as well.
std::vector<std::byte> read_file(const std::string& path);
/// Returns the bytes of a regular file from `offset` on: `most` of them, or as many as there are.
/// Throws RunError.
std::vector<std::byte> read_part(const std::string& path, std::uint64_t offset, std::size_t most);
/// Replaces a file by `head` followed by `body`, not atomically: for files that no other process
/// reads yet. A symbolic link is refused, not followed. Throws RunError.
void write_file(const std::string& path, std::span<const std::byte> head,
                std::span<const std::byte> body);
/// Gives a file its final name, replacing a file of that name. Across file systems: copies, then
/// renames. Throws RunError.
void move_file(const std::string& from, const std::string& to);
/// As move_file(), but where the file system can exchange names, the replaced file stays under the
/// name `from`, to be overwritten. Throws RunError.
void exchange_file(const std::string& from, const std::string& to);
/// Flushes all that was written to the file system of `directory`, so that it outlives a power cut
/// (syncfs: seconds where much was written). Throws RunError.
void flush_to_disk(const std::string& directory);
/// Creates a directory and its parents. Throws RunError.
void make_directory(const std::string& path);
/// Writes all bytes to an open file. Throws RunError that names `path`.
void write_all(int fd, const std::string& path, std::span<const std::byte> bytes);
/// Throws RunError: `path` cannot be written, why (an errno), and what to do.
[[noreturn]] void fail_to_write(const std::string& path, int code);
/// Removes a directory and all in it, or a file, where it exists. Throws RunError.
void remove_directory(const std::string& path);

}  // namespace enfilade
