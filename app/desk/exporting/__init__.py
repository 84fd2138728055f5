"""What is chosen of a picture that is to be exported."""
