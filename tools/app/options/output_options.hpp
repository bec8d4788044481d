// The files that are written.
#pragma once

#include <string>

#include "app/options/command_line.hpp"
#include "app/outputs/diagram_files.hpp"
#include "app/outputs/frame_writer.hpp"

namespace vorocl::command {

/// Adds the option of a file, which must stay where it is. If `numbered`, its path is a pattern for one file
/// per frame.
Option add_file_option(Command& command, FileRequest& request, bool numbered = false);

/// Adds -o, with a help text and the name of its value, --fps and how pictures are drawn.
void add_film_options(Command& command, FrameWriterOptions& options, const std::string& value_name,
                      const std::string& about);

/// Adds all that, the numbered files, --similarity, --statistics and --every.
void add_frame_writer_options(Command& command, FrameWriterOptions& options);

}  // namespace vorocl::command
