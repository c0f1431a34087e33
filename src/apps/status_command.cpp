// suture status: where is the run in this folder?
#include <chrono>
#include <iostream>
#include <memory>
#include <thread>

#include "commands.hpp"
#include "suture/io/run_status.hpp"

namespace suture {

namespace {

void watch(const std::string& directory) {
  while (true) {
    const DirectoryStatus status = describe_run(directory);
    std::cout << status.text << std::flush;
    if (!status.running) return;
    std::this_thread::sleep_for(std::chrono::seconds(2));
  }
}

}  // namespace

void add_status_command(CLI::App& program, CommandResult&) {
  struct Options {
    std::string directory;
    bool watch = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("status", "say where a running, stopped or finished run is");
  command->add_option("DIR", options->directory, "folder of the run")->required();
  command->add_flag("--watch", options->watch, "every two seconds, until it ends");
  command->callback([options] {
    if (options->watch)
      watch(options->directory);
    else
      std::cout << describe_run(options->directory).text;
  });
}

}  // namespace suture
