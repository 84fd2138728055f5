"""The tools: one generator for each gesture."""
