"""Places: where one is and has been, bookmarks, and what is known of where there is paint."""
