"""Time and threads: the worker, requests and results, and what works between the points of the pen."""
