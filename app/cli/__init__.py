"""The commands that need no window, one module each: declare(parser) says what it takes, run(options) does it."""
