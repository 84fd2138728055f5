"""Time, threads and files: commands, history, recordings, the background worker, archives, import and export."""
