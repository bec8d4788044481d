// Binaries of programs that the user's processes keep for each other, in a folder of the user's own.
#pragma once

#include <optional>
#include <string>

#include "vorocl/device.hpp"

namespace vorocl {

/// Where binaries are kept: $XDG_CACHE_HOME/vorocl/binaries, or ~/.cache/vorocl/binaries; empty: nowhere,
/// because there is no such folder or VOROCL_BINARY_CACHE is 0.
std::string binary_folder();

bool is_pocl(const Device& device);

/// Whether binaries are kept for a device: for PoCL's alone. Other drivers keep them well by themselves; PoCL
/// preprocesses the sources each time to find one, which takes 34 ms for each program.
bool keeps_binaries(const Device& device);

/// What a binary depends on: sources, options, device, driver, its compiler, and the processor's features.
/// Empty where none are kept.
std::string binary_key(const Device& device, const std::string& source, const std::string& options);

/// The binary that was kept for a key; none unless the whole file is as it was written, and the file and its
/// folder are the user's alone to write. Never throws for what is on the disk.
std::optional<std::string> kept_binary(const std::string& key);

/// Makes the folder, for the user alone (0700), and removes files that no preparation has used for half a
/// year and those that a killed process left. Throws Error if there can be no such folder.
void open_binary_folder();

/// Keeps a binary in the folder. Its file appears when it is complete; of two processes that keep one, the
/// last one's stays. Throws Error if it cannot be written, which changes nothing.
void keep_binary(const std::string& key, const std::string& binary);

/// Says that a kept binary is still in use.
void use_binary(const std::string& key);

}  // namespace vorocl
