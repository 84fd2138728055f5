"""The sparse pyramid: store, commit rules, lazy evaluation; layers and their compositing."""
