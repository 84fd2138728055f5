"""`inkfall texture example` and `mask`: what is grown like an example, and what is cut out to be one."""
