"""What all tests share: objects of one thread are checked to be touched by no other, also in programs they start."""

import os

os.environ["INKFALL_CHECK_THREADS"] = "1"  # before any module of the program is loaded
