"""The texture doctor: what kind of texture a picture is, what each maker makes of it, and which one suits it."""
