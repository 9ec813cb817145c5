"""What is said: the verdict, its sentence, probabilities, and where the model is wrong."""
