"""The statements and M functions of the conversational language, a file a subject."""
