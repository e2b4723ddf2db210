"""What is simulated: frozen values made of declared parameters, and their files."""
