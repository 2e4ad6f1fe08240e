#pragma once

#include <vector>

#include "client/app/cli_command.h"

/// Every command of `onesea`, one function each; cli_main.cc makes the table.
namespace onesea::app {

CliCommand SessionsCommand();
CliCommand CreateCommand();
CliCommand DeleteCommand();
CliCommand QueryCommand();
CliCommand WatchCommand();
CliCommand WeatherCommand();
CliCommand HoldCommand();
CliCommand ResumeCommand();
CliCommand StepCommand();
CliCommand SpeedCommand();
CliCommand HashCommand();
CliCommand SpectrumCommand();
CliCommand SpawnCommand();
CliCommand PresetsCommand();
CliCommand BodiesCommand();
CliCommand DriveCommand();
CliCommand ImpulseCommand();
CliCommand ExplodeCommand();
CliCommand ObstacleCommand();
CliCommand RegionCommand();
CliCommand InstrumentsCommand();
CliCommand RemoveCommand();
CliCommand RopeCommand();
CliCommand RopesCommand();

}  // namespace onesea::app
