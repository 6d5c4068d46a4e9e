"""The command line: the only place that reads arguments, prints and picks exit codes."""
