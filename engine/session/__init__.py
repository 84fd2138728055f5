"""A painting over time: commands applied, history, replay."""
