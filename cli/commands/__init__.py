"""One module per subcommand. Each has a click command with the name of the module."""
