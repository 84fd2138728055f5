"""`inkfall texture doctor`: which maker suits an example, in words and as a sheet."""
