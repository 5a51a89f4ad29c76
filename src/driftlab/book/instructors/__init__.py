"""What is for instructors alone: a student's copy of the book leaves this folder out."""
