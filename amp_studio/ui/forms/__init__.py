"""Small controls that dialogs and panels are made of."""
