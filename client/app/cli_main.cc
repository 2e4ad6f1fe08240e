// The `onesea` command.

#include <cstdlib>
#include <iostream>

#include "client/app/cli_commands.h"

int main(int argc, char** argv) {
  using namespace onesea::app;  // NOLINT(build/namespaces): the program is this namespace
  const std::vector<CliCommand> commands = {
      SessionsCommand(),    CreateCommand(),   DeleteCommand(),  QueryCommand(),    WatchCommand(),
      WeatherCommand(),     HoldCommand(),     ResumeCommand(),  StepCommand(),     SpeedCommand(),
      HashCommand(),        SpectrumCommand(), SpawnCommand(),   PresetsCommand(),  BodiesCommand(),
      DriveCommand(),       ImpulseCommand(),  ExplodeCommand(), ObstacleCommand(), RegionCommand(),
      InstrumentsCommand(), RopeCommand(),     RopesCommand(),   RemoveCommand()};
  // An error is one line; gRPC would add its own.
  setenv("GRPC_VERBOSITY", "NONE", /*overwrite=*/0);
  const char* server = std::getenv("ONESEA_SERVER");
  const std::vector<std::string> words(argv + 1, argv + argc);
  return RunCli(commands, words, server != nullptr && *server != '\0' ? server : "127.0.0.1:7310",
                std::cout, std::cerr);
}
